#include "record/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "cairn/types.h"

namespace cairn {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* what, int error) {
    throw IoError(fmt::format("{}: {}: {}", file.string(), what, std::strerror(error)));
}

/// Repeats a call that a signal interrupted.
template <class Call>
auto repeated(const Call& call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

/// An open file of the operating system.
class Descriptor {
  public:
    Descriptor(const std::filesystem::path& file, int flags, const char* purpose)
        : id_(repeated([&] { return ::open(file.c_str(), flags | O_CLOEXEC, 0666); })) {
        if (id_ < 0) fail(file, purpose, errno);
    }
    ~Descriptor() {
        if (id_ >= 0) ::close(id_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int get() const { return id_; }
    /// Closes now. @return negative if what was written is not safe
    int close() {
        const int id = id_;
        id_ = -1;
        return ::close(id);
    }

  private:
    int id_;
};

void writeAll(const Descriptor& out, std::span<const std::byte> bytes, const std::filesystem::path& file) {
    while (!bytes.empty()) {
        const ssize_t written = repeated([&] { return ::write(out.get(), bytes.data(), bytes.size()); });
        if (written < 0) fail(file, "cannot be written", errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

}  // namespace

void replaceFile(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    replaceFile(file, [bytes](const AppendBytes& append) { append(bytes); });
}

void replaceFile(const std::filesystem::path& file, const std::function<void(const AppendBytes&)>& write) {
    const std::filesystem::path beside = file.string() + ".partial";
    try {
        Descriptor out(beside, O_WRONLY | O_CREAT | O_TRUNC, "cannot be written");
        write([&](std::span<const std::byte> bytes) { writeAll(out, bytes, beside); });
        if (repeated([&] { return ::fsync(out.get()); }) < 0) fail(beside, "cannot be made durable", errno);
        if (out.close() < 0) fail(beside, "cannot be closed", errno);
        if (std::rename(beside.c_str(), file.c_str()) < 0) fail(file, "cannot be replaced", errno);
    } catch (...) {
        ::unlink(beside.c_str());
        throw;
    }
    // The new name itself must survive a power failure; folders that cannot be opened keep the old or the new one.
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const Descriptor names(folder, O_RDONLY | O_DIRECTORY, "cannot be opened");
    if (repeated([&] { return ::fsync(names.get()); }) < 0 && errno != EINVAL) {
        fail(folder, "cannot be made durable", errno);
    }
}

std::vector<std::byte> readFile(const std::filesystem::path& file) {
    const Descriptor in(file, O_RDONLY, "cannot be read");
    struct stat state {};
    if (::fstat(in.get(), &state) < 0) fail(file, "cannot be read", errno);
    if (!S_ISREG(state.st_mode)) throw IoError(fmt::format("{}: is not a file", file.string()));
    std::vector<std::byte> bytes(static_cast<std::size_t>(state.st_size));
    std::size_t end = 0;
    while (end < bytes.size()) {
        const ssize_t got = repeated([&] { return ::read(in.get(), bytes.data() + end, bytes.size() - end); });
        if (got < 0) fail(file, "cannot be read", errno);
        if (got == 0) break;
        end += static_cast<std::size_t>(got);
    }
    bytes.resize(end);
    return bytes;
}

}  // namespace cairn
