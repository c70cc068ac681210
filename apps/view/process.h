/// @file Other programs: the browser, headless Chromium and ffmpeg.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::view {

/// A program that runs until this object ends, its descendants included.
class Process {
  public:
    enum class Input { none, pipe };
    enum class Output { keep, drop };

    /// @param command program (looked up on the PATH) and arguments @throws IoError if it cannot be started
    Process(const std::vector<std::string>& command, Input input, Output output);
    /// Ends the program and waits for it.
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Writes to its standard input. @throws IoError if it reads no more
    void write(std::string_view bytes);
    void closeInput();
    bool running();
    /// Waits for its end. @return its exit code, 128 or more after a signal
    int wait();

  private:
    pid_t pid_ = -1;
    int input_ = -1;
    int exit_code_ = -1;
};

/// The first of these programs on the PATH; empty if there is none.
std::string findProgram(const std::vector<std::string>& names);

/// Opens an address in the user's browser, if a display is there. @return false if there is none
bool openBrowser(const std::string& address);

/// A new folder for temporary files, removed with this object.
class TemporaryFolder {
  public:
    /// @throws IoError
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace cairn::view
