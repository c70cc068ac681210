#include "record/file_driver.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace cairn::hdf5 {

namespace {

/// What the access properties carry to the driver.
struct DriverInfo {
    WriteState* state;
};

/// A write that did not reach the file.
struct KeptWrite {
    haddr_t address;
    std::vector<char> bytes;
};

/// HDF5 sees the first member only.
struct OpenFile {
    H5FD_t base;
    int descriptor;
    haddr_t end_of_allocation;
    haddr_t end_of_file;
    WriteState* state;
    std::vector<KeptWrite>* kept;  ///< since the failure, in order
};
static_assert(std::is_standard_layout_v<OpenFile>, "HDF5's part must be at the address of the whole");

OpenFile& own(H5FD_t* file) {
    return *reinterpret_cast<OpenFile*>(file);
}
const OpenFile& own(const H5FD_t* file) {
    return *reinterpret_cast<const OpenFile*>(file);
}

H5FD_t* openFile(const char* name, unsigned, hid_t access, haddr_t) {
    const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
    const int descriptor = ::open(name, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        info->state->error = errno;
        return nullptr;
    }
    auto file = std::make_unique<OpenFile>(OpenFile{H5FD_t{}, descriptor, 0, 0, info->state, nullptr});
    file->kept = std::make_unique<std::vector<KeptWrite>>().release();
    return &file.release()->base;
}

herr_t closeFile(H5FD_t* file) {
    const std::unique_ptr<OpenFile> owned(&own(file));
    const std::unique_ptr<std::vector<KeptWrite>> kept(owned->kept);
    // Some file systems report a full disk only now.
    if (::close(owned->descriptor) != 0 && owned->state->error == 0) owned->state->error = errno;
    return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t endOfAllocation(const H5FD_t* file, H5FD_mem_t) {
    return own(file).end_of_allocation;
}

void setLength(OpenFile& file, haddr_t length) {
    if (file.state->error == 0 && ::ftruncate(file.descriptor, static_cast<off_t>(length)) != 0) {
        file.state->error = errno;
    }
    file.end_of_file = length;
}

/// The file grows at once, so that it is never shorter than its superblock says; a shorter one has been cut.
herr_t setEndOfAllocation(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    own(file).end_of_allocation = end;
    if (end > own(file).end_of_file) setLength(own(file), end);
    return 0;
}

haddr_t endOfFile(const H5FD_t* file, H5FD_mem_t) {
    return own(file).end_of_file;
}

/// What HDF5 reads beyond the end are zeros.
bool readFromDisk(int descriptor, haddr_t address, char* to, size_t size) {
    while (size > 0) {
        const ssize_t got = ::pread(descriptor, to, size, static_cast<off_t>(address));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return false;
        if (got == 0) {
            std::memset(to, 0, size);
            return true;
        }
        to += got;
        address += static_cast<haddr_t>(got);
        size -= static_cast<size_t>(got);
    }
    return true;
}

herr_t readFile(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) {
    auto* to = static_cast<char*>(buffer);
    if (!readFromDisk(own(file).descriptor, address, to, size)) return -1;
    for (const KeptWrite& write : *own(file).kept) {
        const haddr_t begin = std::max(address, write.address);
        const haddr_t end = std::min(address + size, write.address + write.bytes.size());
        if (begin < end) std::memcpy(to + (begin - address), write.bytes.data() + (begin - write.address), end - begin);
    }
    return 0;
}

/// @return 0, or the errno of the failure
int writeToDisk(int descriptor, haddr_t address, const char* from, size_t size) {
    while (size > 0) {
        const ssize_t put = ::pwrite(descriptor, from, size, static_cast<off_t>(address));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return errno;
        from += put;
        address += static_cast<haddr_t>(put);
        size -= static_cast<size_t>(put);
    }
    return 0;
}

herr_t writeFile(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* buffer) {
    OpenFile& to = own(file);
    const auto* from = static_cast<const char*>(buffer);
    to.end_of_file = std::max<haddr_t>(to.end_of_file, address + size);
    if (to.state->error == 0) to.state->error = writeToDisk(to.descriptor, address, from, size);
    if (to.state->error != 0) to.kept->push_back({address, std::vector<char>(from, from + size)});
    return 0;
}

herr_t truncateFile(H5FD_t* file, hid_t, hbool_t) {
    if (own(file).end_of_allocation != own(file).end_of_file) setLength(own(file), own(file).end_of_allocation);
    return 0;
}

herr_t lockFile(H5FD_t* file, hbool_t exclusive) {
    const int locked = ::flock(own(file).descriptor, (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB);
    // File systems without locks cannot protect anybody; that is no reason not to record.
    return locked == 0 || errno == ENOSYS || errno == EOPNOTSUPP || errno == ENOLCK ? 0 : -1;
}

herr_t unlockFile(H5FD_t* file) {
    ::flock(own(file).descriptor, LOCK_UN);
    return 0;
}

/// Two files are never the same: each is created anew.
int compare(const H5FD_t* a, const H5FD_t* b) {
    return a < b ? -1 : static_cast<int>(a > b);
}

constexpr H5FD_class_t describeDriver() {
    H5FD_class_t driver{};
    driver.name = "cairn";
    driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(DriverInfo);
    driver.open = openFile;
    driver.close = closeFile;
    driver.cmp = compare;
    driver.query = query;
    driver.get_eoa = endOfAllocation;
    driver.set_eoa = setEndOfAllocation;
    driver.get_eof = endOfFile;
    driver.read = readFile;
    driver.write = writeFile;
    driver.truncate = truncateFile;
    driver.lock = lockFile;
    driver.unlock = unlockFile;
    std::fill(std::begin(driver.fl_map), std::end(driver.fl_map), H5FD_MEM_DRAW);
    driver.fl_map[H5FD_MEM_DEFAULT] = H5FD_MEM_SUPER;
    for (const H5FD_mem_t metadata : {H5FD_MEM_SUPER, H5FD_MEM_BTREE, H5FD_MEM_LHEAP, H5FD_MEM_OHDR}) {
        driver.fl_map[metadata] = H5FD_MEM_SUPER;
    }
    return driver;
}

/// HDF5 keeps the address of the description.
constexpr H5FD_class_t driver_class = describeDriver();

}  // namespace

FileDriver::FileDriver(const std::filesystem::path& path)
    : id_(H5FDregister(&driver_class), path, "HDF5 refuses the file driver") {}

void FileDriver::useFor(const Properties& access, WriteState& state, const std::filesystem::path& path) const {
    const DriverInfo info{&state};
    checked(H5Pset_driver(access.get(), id_.get(), &info), path, "HDF5 refuses the file driver");
}

}  // namespace cairn::hdf5
