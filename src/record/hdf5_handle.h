/// @file Owners of HDF5 ids, and HDF5's errors as exceptions.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace cairn::hdf5 {

/// Keeps HDF5 from printing its error stack while it lives; the caller's handler comes back afterwards.
class QuietErrors {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    H5E_auto2_t handler_ = nullptr;
    void* data_ = nullptr;
};

/// Why the last call failed, in a few words; the system's reason if there is one.
std::string lastError();

/// @throws IoError "FILE: what: reason"
[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what);

/// Passes on what a call returned. @throws IoError if that is negative
template <typename Result>
Result checked(Result result, const std::filesystem::path& file, std::string_view what) {
    if (result < 0) fail(file, what);
    return result;
}

/// Owns an id and closes it.
template <herr_t (*Close)(hid_t)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(hid_t id) : id_(id) {}
    /// @throws IoError if the call that made the id failed
    Handle(hid_t id, const std::filesystem::path& file, std::string_view what) : id_(checked(id, file, what)) {}
    ~Handle() { close(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            close();
            id_ = std::exchange(other.id_, H5I_INVALID_HID);
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    hid_t get() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
    /// Closes now. @return negative if HDF5 could not
    herr_t close() {
        const hid_t id = std::exchange(id_, H5I_INVALID_HID);
        return id >= 0 ? Close(id) : 0;
    }

  private:
    hid_t id_ = H5I_INVALID_HID;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using DataSet = Handle<H5Dclose>;
using DataSpace = Handle<H5Sclose>;
using DataType = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Properties = Handle<H5Pclose>;

}  // namespace cairn::hdf5
