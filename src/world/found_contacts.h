/// @file What the threads of a detection find, and how it becomes the contacts of the step.
#pragma once

#include <cstdint>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "body/material_table.h"
#include "parallel/executor.h"

namespace cairn {

struct StepData;

/// Most contacts of a step: they are numbered with 32 bits, and so many fill 460 GB.
inline constexpr std::size_t most_contacts = 2'000'000'000;

/// @throws InputError if a step has more than most_contacts
void requireContacts(std::size_t count);

/// What the detection finds of a contact.
struct FoundContact {
    BodyIndex a;
    BodyIndex b;
    Vec3 point;       ///< [m, W]
    Vec3 normal;      ///< from B to A
    double distance;  ///< [m]
};

/// What one thread found, in the order of the pairs.
struct FoundContacts {
    /// Contacts side by side: those that StepData::contacts has of the last detection, or of found.
    struct Piece {
        std::uint32_t from;  ///< index of the first, there
        std::uint32_t count;
        bool stays;  ///< they are those of the last detection
    };
    std::vector<FoundContact> found;
    std::vector<Piece> pieces;
    std::size_t count = 0;  ///< of all pieces

    void clear();
    /// Appends contacts. @param from, contacts, stays as of Piece
    void add(std::size_t from, std::size_t contacts, bool stays);
};

/// Which detection of a step it is.
enum class DetectionRound : std::uint8_t { first, later };

/// Makes the contacts of a step of what the threads found. Those that stay keep their places as far as they can.
/// @param data thread_contacts: those of ascending blocks of the sorted pairs; contacts: replaced, sorted
/// @throws InputError beyond most_contacts
void joinContacts(const BodyStorage& bodies, const MaterialTable& materials, const Executor& executor,
                  DetectionRound round, StepData& data);

}  // namespace cairn
