/// @file Text for the standard output, the standard error and files, with every error noticed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace cairn::cli {

/// Who read the standard output does not want more; ends the program without a message.
struct ReaderGone {};

/// Writes to the standard output. @throws IoError, ReaderGone
void printOut(std::string_view text);
/// Writes "cairn: error: MESSAGE" to the standard error.
void printError(std::string_view message);
/// Writes a line to a stream, without caring whether it arrives.
void printLine(std::FILE* stream, std::string_view line);

/// A text file that can be read while it is written.
class TextFile {
  public:
    /// @throws IoError
    explicit TextFile(const std::filesystem::path& path);
    /// Adds text, and hands it to the operating system. @throws IoError
    void write(std::string_view text);

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace cairn::cli
