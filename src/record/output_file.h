/// @file A file that is written from the beginning to the end, and says so when it cannot be.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace cairn {

class OutputFile {
  public:
    /// Creates or empties the file. @throws IoError
    explicit OutputFile(const std::filesystem::path& path);
    /// @throws IoError
    void write(std::string_view bytes);
    /// Everything is with the operating system afterwards. @throws IoError
    void close();

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace cairn
