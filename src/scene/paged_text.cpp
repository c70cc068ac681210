#include "scene/paged_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "cairn/types.h"

namespace cairn {
namespace {

constexpr std::size_t page_size = std::size_t{1} << 18U;  ///< [bytes]

}  // namespace

/// What tells that a file was changed.
struct TextFile::State {
    std::size_t size;
    long long changed;
};

TextFile::TextFile(std::filesystem::path path)
    : name_(path.string()), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat found {};
    const bool sound = descriptor_ >= 0 && fstat(descriptor_, &found) == 0;
    if (!sound || !S_ISREG(found.st_mode)) {
        const char* const reason = sound ? "not a file with a length" : std::strerror(errno);
        if (descriptor_ >= 0) close(descriptor_);
        throw IoError(fmt::format("{}: cannot be read ({}); give the path of a scene file", name_, reason));
    }
    const State now = state();
    size_ = now.size;
    changed_ = now.changed;
}

TextFile::~TextFile() {
    close(descriptor_);
}

TextFile::State TextFile::state() const {
    struct stat found {};
    fstat(descriptor_, &found);
    return {static_cast<std::size_t>(found.st_size), 1'000'000'000LL * found.st_mtim.tv_sec + found.st_mtim.tv_nsec};
}

void TextFile::read(std::size_t offset, std::string& page) const {
    page.resize(std::min(page_size, size_ - offset));
    std::size_t done = 0;
    while (done < page.size()) {
        const ssize_t count =
            pread(descriptor_, page.data() + done, page.size() - done, static_cast<off_t>(offset + done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw IoError(fmt::format("{}: cannot be read ({})", name_, std::strerror(errno)));
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    const State now = state();
    if (done == page.size() && now.size == size_ && now.changed == changed_) return;
    throw IoError(
        fmt::format("{}: was changed while it was used; leave the file of a scene as it is until the run ends, "
                    "or put another in its place",
                    name_));
}

PagedText::PagedText(std::shared_ptr<const TextFile> file) : file_(std::move(file)), size_(file_->size()) {}

PagedText::PagedText(const PagedText& other)
    : file_(other.file_), size_(other.size_), page_(file_ == nullptr ? other.page_ : std::string_view()) {}

void PagedText::turnTo(std::size_t i) {
    begin_ = i;
    file_->read(begin_, read_);
    page_ = read_;
}

std::string_view PagedText::part(TextRange range) {
    if (range.begin >= begin_ && range.end <= begin_ + page_.size()) {
        return page_.substr(range.begin - begin_, range.end - range.begin);
    }
    try {
        part_.resize(range.end - range.begin);
    } catch (const std::bad_alloc&) {
        throw IoError(fmt::format("{}: cannot be read; {} bytes of it are more than the memory that is free",
                                  file_->name(), range.end - range.begin));
    }
    for (std::size_t at = range.begin; at < range.end;) {
        if (at - begin_ >= page_.size()) turnTo(at);
        const std::size_t count = std::min(range.end, begin_ + page_.size()) - at;
        std::memcpy(part_.data() + (at - range.begin), page_.data() + (at - begin_), count);
        at += count;
    }
    return part_;
}

}  // namespace cairn
