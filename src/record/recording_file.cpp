#include "record/recording_file.h"

#include <fmt/format.h>

#include <cstring>

#include "cairn/types.h"
#include "record/attributes.h"
#include "record/layout.h"

namespace cairn::hdf5 {

namespace {

/// HDF5 reads metadata again when a writer was in the middle of it, and waits twice as long after each attempt, 1 ns
/// first: this is an eighth of a second, in which also a writer on a busy machine gets its turn. Its own limit of 100
/// attempts takes minutes on a truncated file.
constexpr unsigned metadata_read_attempts = 27;

/// A kill ends a write between two pages of the system. HDF5's pages are as large, and no part of its metadata that
/// fits into one lies in two, so a writer that is killed leaves such a part as it was or as it should be.
constexpr hsize_t page_size = 4096;

}  // namespace

File createFile(const std::filesystem::path& path, const FileDriver& driver, WriteState& state) {
    const Properties access(H5Pcreate(H5P_FILE_ACCESS), path, "cannot be created");
    // Single writer, multiple readers needs the file format of HDF5 1.10, which later versions read as well.
    checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110), path, "cannot be created");
    checked(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), path, "cannot be created");
    driver.useFor(access, state, path);
    const Properties creation(H5Pcreate(H5P_FILE_CREATE), path, "cannot be created");
    checked(H5Pset_file_space_strategy(creation.get(), H5F_FSPACE_STRATEGY_PAGE, false, 1), path, "cannot be created");
    checked(H5Pset_file_space_page_size(creation.get(), page_size), path, "cannot be created");
    File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()));
    if (!file && state.error == 0) fail(path, "cannot be created");
    return file;
}

File openFile(const std::filesystem::path& path, const FileState& state) {
    // A file that its writer did not close (yet) can only be opened as a reader beside a writer.
    const unsigned flags = state.closed ? H5F_ACC_RDONLY : H5F_ACC_RDONLY | H5F_ACC_SWMR_READ;
    const Properties access(H5Pcreate(H5P_FILE_ACCESS), path, "cannot be opened");
    checked(H5Pset_metadata_read_attempts(access.get(), metadata_read_attempts), path, "cannot be opened");
    return File(H5Fopen(path.c_str(), flags, access.get()), path,
                "is damaged, or its writer ended before the first frame");
}

void requireFormat(const File& file, const std::filesystem::path& path, std::string_view name) {
    const auto format = readAttribute(file.get(), path, layout::format_attribute);
    if (format != SettingValue(std::string(name))) {
        throw IoError(
            fmt::format("{}: is an HDF5 file, but not a {} of Cairn", path.string(), name.substr(name.find(' ') + 1)));
    }
    const auto format_version = readAttribute(file.get(), path, layout::format_version_attribute);
    if (format_version != SettingValue(layout::format_version)) {
        throw IoError(
            fmt::format("{}: is a recording in another format version than {}, which this Cairn reads; "
                        "use the version of Cairn that wrote it",
                        path.string(), layout::format_version));
    }
}

void requireWritten(const WriteState& state, const std::filesystem::path& path, std::string_view what) {
    if (state.error == 0) return;
    throw IoError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(state.error)));
}

std::uint64_t numberAttribute(const File& file, const std::filesystem::path& path, const char* name) {
    if (H5Aexists(file.get(), name) <= 0) return 0;
    const auto value = readAttribute(file.get(), path, name);
    const auto* number = value ? std::get_if<std::int64_t>(&*value) : nullptr;
    if (number != nullptr && *number >= 0) return static_cast<std::uint64_t>(*number);
    throw IoError(fmt::format("{}: is damaged: its {} is no number", path.string(), name));
}

}  // namespace cairn::hdf5
