/// @file Motion clamping: how far bodies that flew too deep into each other have to go back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_way.h"
#include "body/contact.h"
#include "broad_phase/neighbour_list.h"
#include "pairs/foreseen.h"
#include "parallel/executor.h"

namespace cairn {

/// Flights may lead bodies into each other by this multiple of the overlap that they are allowed.
inline constexpr double most_flown_overlap = 1.3;

/// Whether the bodies of a contact are in each other by more than that. @param contact Contact or FoundContact
inline bool isDeeperThanFlown(const auto& contact) {
    return contact.distance < -most_flown_overlap * contact.allowed_overlap;
}

/// Two bodies that got too deep into each other.
struct TooDeep {
    BodyPair pair;
    double part = 0;  ///< of their flights: to where both go back that got farther
};

/// What is known of the ways.
struct WaysInput {
    const BodyStorage& bodies;
    std::span<const ContactPair> pairs;
    std::span<const Contact> contacts;
    const DetectionRange& range;
    std::span<const BodyWay> ways;          ///< [slots]
    std::span<const std::uint8_t> jointed;  ///< [slots] 1 = does not go back; empty = none
    std::span<const std::uint8_t> stuck;    ///< [slots] 1 = does not go back, as findStuck() found
    std::span<const std::uint8_t> back;     ///< [slots] of those that went back since all were asked; empty = ask all
    const Executor& executor;
};

/// Finds bodies that were far deeper in others already where they began to fly than impacts and weights lead, as a
/// scene or a user put them: they come apart only through each other.
/// @param stuck out: [slots] 1 = is one of them
void findStuck(const WaysInput& input, std::vector<std::uint8_t>& stuck);

/// How far points of a body's surface went at most as it turned [m]. What is round about an axis may turn about it as
/// it likes. @param before its orientation then
double turnedWay(const BodyStorage& bodies, BodyIndex i, const Quat& before);

/// Whether a body may go back.
bool mayGoBack(const WaysInput& input, BodyIndex i);

/// How far bodies flew.
struct Flights {
    std::vector<std::uint8_t> flew;  ///< [slots] 1 = it did, as far as is known of its way
    std::vector<double> turned;      ///< [slots] turnedWay() of each [m]
    double smallest = 0;             ///< inner radius of a body [m]
    bool far = false;  ///< points of two bodies may have flown past each other by more than the inner radius of one
};

/// Measures the flights of those that are asked; whoever went back flew no farther than before.
void measureFlights(const WaysInput& input, Flights& flights);

/// Finds the pairs whose bodies are deeper in each other than they may be in a fall and were where they began to fly,
/// and those of which one flew through the other. @param found out: by thread, in the order of the pairs
void findTooDeep(const WaysInput& input, const Flights& flights, std::vector<std::vector<TooDeep>>& found);

/// A body that was moved without flying, as by the correction.
struct MovedBody {
    double way = 0;      ///< how far its surface went at most [m]
    double unsure = 0;   ///< and before, since contacts were found [m]
    double deepest = 0;  ///< an overlap that it may share with neighbours, as a multiple of what is allowed there
};

/// Finds the pairs that were pressed deeper into each other than they may be, than they were, and than most of what one
/// of them was in somebody else: what cannot go at once is shared with neighbours, and becomes less.
/// @param input with the ways of those that were moved @param moved [slots] @param found as of findTooDeep()
void findPressed(const WaysInput& input, std::span<const MovedBody> moved, std::vector<std::vector<TooDeep>>& found);

/// What the normal of a contact tells of bodies that were moved since may be too much: a pair is no deeper in each
/// other than where it really is. @param contacts the same as of the input; out: distances @param moved [slots]
void limitToDepths(const WaysInput& input, std::span<const MovedBody> moved, std::span<Contact> contacts);

}  // namespace cairn
