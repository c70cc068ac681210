/// @file Texts that may be larger than the memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace cairn {

/// A part of a text.
struct TextRange {
    std::size_t begin = 0;  ///< [bytes]
    std::size_t end = 0;    ///< one behind the last [bytes]
};

/// A file that stays the same one, whatever its name means later.
class TextFile {
  public:
    /// @throws IoError if it cannot be read, or is no file with a length
    explicit TextFile(std::filesystem::path path);
    ~TextFile();
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;

    const std::string& name() const { return name_; }
    std::size_t size() const { return size_; }
    /// Fills a page, which is shorter at the end of the file. @throws IoError if the file was changed since
    void read(std::size_t offset, std::string& page) const;

  private:
    struct State;
    State state() const;

    std::string name_;
    int descriptor_ = -1;
    std::size_t size_ = 0;
    long long changed_ = 0;  ///< when it was changed last [ns]
};

/// A text of which a page is in memory, or one that is there anyway. A copy goes over it by itself.
class PagedText {
  public:
    /// @param text must outlive this
    explicit PagedText(std::string_view text) : size_(text.size()), page_(text) {}
    explicit PagedText(std::shared_ptr<const TextFile> file);
    PagedText(const PagedText& other);
    PagedText& operator=(const PagedText&) = delete;
    ~PagedText() = default;

    std::size_t size() const { return size_; }
    /// @pre i < size() @throws IoError as TextFile
    char operator[](std::size_t i) {
        if (i - begin_ >= page_.size()) turnTo(i);
        return page_[i - begin_];
    }
    /// A part of it, until the next call. @throws IoError as TextFile, or if the memory does not suffice
    std::string_view part(TextRange range);
    std::string_view all() { return part({0, size_}); }

  private:
    void turnTo(std::size_t i);

    std::shared_ptr<const TextFile> file_;
    std::size_t size_ = 0;
    std::size_t begin_ = 0;  ///< of the page
    std::string_view page_;
    std::string read_;  ///< the page, of a file
    std::string part_;  ///< that was asked for last, if it is on several pages
};

}  // namespace cairn
