#include "cli/companions.h"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cairn/types.h"

namespace cairn::cli {

namespace {

std::filesystem::path find(const Companion& companion) {
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::filesystem::path file = folder / companion.program;
    if (access(file.c_str(), X_OK) == 0) return file;
    throw IoError(
        fmt::format("'{0}' is a program of its own, which is not in '{1}'; 'make {0}' in Cairn's source folder builds "
                    "it, and 'make install' installs it with all others",
                    companion.program, folder.string()));
}

/// The command as exec and spawn take it.
class CommandLine {
  public:
    CommandLine(const std::filesystem::path& program, const std::vector<std::string>& arguments) : words_(arguments) {
        words_.insert(words_.begin(), program.string());
        for (std::string& word : words_) pointers_.push_back(word.data());
        pointers_.push_back(nullptr);
    }
    char* const* get() { return pointers_.data(); }

  private:
    std::vector<std::string> words_;
    std::vector<char*> pointers_;
};

/// While it lives, Ctrl-C is left to the program that is waited for.
class IgnoredInterrupts {
  public:
    IgnoredInterrupts() {
        struct sigaction ignore {};
        ignore.sa_handler = SIG_IGN;
        sigaction(SIGINT, &ignore, &interrupt_before_);
        sigaction(SIGQUIT, &ignore, &quit_before_);
    }
    ~IgnoredInterrupts() {
        sigaction(SIGINT, &interrupt_before_, nullptr);
        sigaction(SIGQUIT, &quit_before_, nullptr);
    }
    IgnoredInterrupts(const IgnoredInterrupts&) = delete;
    IgnoredInterrupts& operator=(const IgnoredInterrupts&) = delete;

  private:
    struct sigaction interrupt_before_ {};
    struct sigaction quit_before_ {};
};

int exitCode(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void becomeCompanion(const Companion& companion, const std::vector<std::string>& arguments) {
    const std::filesystem::path program = find(companion);
    // What this program set for itself (see ignoreBrokenPipes) is not what the companion is to begin with.
    signal(SIGPIPE, SIG_DFL);
    execv(program.c_str(), CommandLine(program, arguments).get());
    throw IoError(fmt::format("'{}' cannot be started: {}", program.string(), std::strerror(errno)));
}

int runCompanion(const Companion& companion, const std::vector<std::string>& arguments) {
    const std::filesystem::path program = find(companion);
    const IgnoredInterrupts ignored;
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGQUIT, SIGPIPE}) sigaddset(&usual, signal);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = -1;
    const int error =
        posix_spawn(&child, program.c_str(), nullptr, &attributes, CommandLine(program, arguments).get(), environ);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) throw IoError(fmt::format("'{}' cannot be started: {}", program.string(), std::strerror(error)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return exitCode(status);
}

}  // namespace cairn::cli
