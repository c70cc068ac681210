/// @file Reads the file of a rank of a recording in parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "cairn/recording.h"

namespace cairn {

/// A frame of a recording in which no body and no joint is there yet.
Frame emptyFrame(const RecordingInfo& info);

/// Brings contacts that come from several parts into the order of World::contacts().
void sortContacts(Frame& frame);

class PartReader {
  public:
    /// @param file that the recording is named by @param mark that the part must have @param info of the recording
    /// @throws IoError if it is missing, damaged, or a part of another recording
    PartReader(const std::filesystem::path& file, std::size_t rank, std::uint64_t mark, const RecordingInfo& info);
    ~PartReader();
    PartReader(const PartReader&) = delete;
    PartReader& operator=(const PartReader&) = delete;

    std::size_t frames() const;
    /// Adds what the rank had. @throws IoError
    void read(std::size_t index, Frame& frame) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cairn
