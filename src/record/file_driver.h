/// @file How HDF5 reaches the file of a recording: a driver that survives a full disk.
///
/// HDF5 1.10 does not recover from a failed write: closing the file afterwards can crash. So this driver notes the
/// failure, tells HDF5 that all is well, and keeps in memory what HDF5 writes from then on. The file then holds what
/// was written up to the failure, exactly as if the program had been killed there, which single-writer mode allows for.
#pragma once

#include <hdf5.h>

#include <filesystem>

#include "record/hdf5_handle.h"

namespace cairn::hdf5 {

/// What happened to the writes of a file.
struct WriteState {
    int error = 0;  ///< errno of the first write that failed; 0 if none
};

/// The registered driver; must live as long as files that use it.
class FileDriver {
  public:
    /// @param path for messages @throws IoError
    explicit FileDriver(const std::filesystem::path& path);

    /// Lets a file that is created with these properties use the driver.
    /// @param access file access properties @param state must outlive the file @throws IoError
    void useFor(const Properties& access, WriteState& state, const std::filesystem::path& path) const;

  private:
    Handle<H5FDunregister> id_;
};

}  // namespace cairn::hdf5
