/// @file Runs the program as a shell would.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::test {

/// What a finished program left.
struct Finished {
    int code = -1;      ///< exit code; -1 if a signal ended it
    std::string out;    ///< standard output
    std::string error;  ///< standard error
};

/// A running `cairn`. Its outputs go to files in a folder of its own, which is also its working directory.
class Program {
  public:
    /// @param folder must exist @param out where the standard output goes; empty = kept
    Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
            const std::string& out = "");
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) const;
    /// Waits for its end.
    Finished finish();

  private:
    std::filesystem::path out_;
    std::filesystem::path error_;
    pid_t id_ = -1;
};

/// Runs `cairn` with arguments to its end.
Finished runProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const std::string& out = "");

}  // namespace cairn::test
