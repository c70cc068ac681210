/// @file What the threads of a detection find, and how it becomes the contacts of the step.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "body/material_table.h"
#include "parallel/executor.h"

namespace cairn {

/// Most contacts of a step: they are numbered with 32 bits, and so many fill 460 GB.
inline constexpr std::size_t most_contacts = 2'000'000'000;

/// @throws InputError if a step has more than most_contacts
void requireContacts(std::size_t count);

/// What the detection finds of a contact.
struct FoundContact {
    BodyIndex a;
    BodyIndex b;
    Vec3 point;                             ///< [m, W]
    Vec3 normal;                            ///< from B to A
    double distance;                        ///< [m]
    double allowed_overlap = 0;             ///< Contact::allowed_overlap
    double allowed_closing = 0;             ///< Contact::allowed_closing
    Vec3 slide = Vec3::Zero();              ///< Contact::slide
    double squared_patch = 0;               ///< of its pair, as of squaredPatchOf()
    Vec3 last_impulse = Vec3::Zero();       ///< Contact::last_impulse
    Vec3 reference_impulse = Vec3::Zero();  ///< Contact::reference_impulse
    Vec3 earlier_impulse = Vec3::Zero();    ///< Contact::earlier_impulse
    Vec3 earlier_angular_impulse = Vec3::Zero();
};

/// How wide, halved and squared, the area is in which the bodies of some contacts touch, where it is narrowest [m²]:
/// the least spread of its points about their middle, of which four corners have half a side. 0 for a point or a line.
double squaredPatchOf(std::span<const FoundContact> contacts);

/// What one thread found, in the order of the pairs.
struct FoundContacts {
    /// Contacts side by side: those that the step has of the last detection, or of found.
    struct Run {
        std::uint32_t from;  ///< index of the first, there
        std::uint32_t count;
        bool stays;  ///< they are those of the last detection
    };
    /// A pair that got contacts behind those that it had.
    struct Grown {
        std::size_t pair;     ///< its index
        std::uint32_t count;  ///< of the new contacts
    };
    /// A contact that does not keep its bodies apart until the end of the step.
    struct Tightened {
        std::size_t pair;        ///< index of its pair
        std::uint32_t place;     ///< among the contacts of the pair
        double allowed_closing;  ///< that does [m/s]
    };
    std::vector<FoundContact> found;
    std::vector<Run> runs;
    std::vector<Grown> grown;
    std::vector<Tightened> tightened;
    std::vector<const Contact*> left;          ///< of the pair at hand, as of inheritImpulses()
    std::size_t count = 0;                     ///< of all runs
    std::size_t pair_begin = 0, pair_end = 0;  ///< the pairs that the thread tests
    bool others = false;                       ///< one of these has more or fewer contacts than before
    bool deep = false;                         ///< flights led bodies of one of these too deep into each other

    void clear();
    /// Appends contacts. @param from, contacts, stays as of Run
    void add(std::size_t from, std::size_t contacts, bool stays);
    /// Notes what a contact of a pair must allow at most, if it allows more. @param allowed_now [m/s]
    void tighten(const Tightened& wanted, double allowed_now);
};

/// Makes the contacts of a step of what the threads found.
class ContactJoiner {
  public:
    /// Those that stay keep their places as far as they can.
    /// @param parts those of ascending blocks of the sorted pairs @param contacts replaced, sorted
    /// @throws InputError beyond most_contacts
    void join(const BodyStorage& bodies, const MaterialTable& materials, const Executor& executor,
              std::span<const FoundContacts> parts, std::vector<Contact>& contacts);

  private:
    void moveStaying(std::span<const FoundContacts> parts, std::size_t total, std::vector<Contact>& contacts);

    std::vector<std::pair<FoundContacts::Run, std::size_t>> moving_up_;  ///< runs that move up, and where to
};

}  // namespace cairn
