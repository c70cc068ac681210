#include "process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

#include "cairn/types.h"

namespace cairn::view {

namespace {

/// posix_spawn's settings, freed at the end.
struct SpawnPlan {
    SpawnPlan() {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
    }
    ~SpawnPlan() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
};

void dropOutput(SpawnPlan& plan) {
    posix_spawn_file_actions_addopen(&plan.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&plan.files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
}

int exitCode(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Process::Process(const std::vector<std::string>& command, Input input, Output output) {
    SpawnPlan plan;
    int ends[2] = {-1, -1};
    if (input == Input::pipe) {
        if (pipe2(ends, O_CLOEXEC) != 0) throw IoError(fmt::format("no pipe: {}", std::strerror(errno)));
        posix_spawn_file_actions_adddup2(&plan.files, ends[0], STDIN_FILENO);
    } else {
        posix_spawn_file_actions_addopen(&plan.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    if (output == Output::drop) dropOutput(plan);
    // A group of its own: a browser has many processes, and Ctrl-C is for us.
    posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int error = posix_spawnp(&pid_, arguments[0], &plan.files, &plan.attributes, arguments.data(), environ);
    if (ends[0] >= 0) close(ends[0]);
    input_ = ends[1];
    if (error != 0) {
        closeInput();
        throw IoError(fmt::format("'{}' cannot be started: {}", command.front(), std::strerror(error)));
    }
}

Process::~Process() {
    closeInput();
    if (exit_code_ >= 0) return;
    kill(-pid_, SIGTERM);
    for (int i = 0; i < 50 && running(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (exit_code_ < 0) {
        kill(-pid_, SIGKILL);
        wait();
    }
}

void Process::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(input_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw IoError(fmt::format("a program takes no more input: {}", std::strerror(errno)));
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void Process::closeInput() {
    if (input_ >= 0) close(input_);
    input_ = -1;
}

bool Process::running() {
    if (exit_code_ >= 0) return false;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
    exit_code_ = exitCode(status);
    return false;
}

int Process::wait() {
    if (exit_code_ >= 0) return exit_code_;
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    exit_code_ = exitCode(status);
    return exit_code_;
}

std::string findProgram(const std::vector<std::string>& names) {
    const char* path = std::getenv("PATH");
    for (const std::string& name : names) {
        std::istringstream folders(path == nullptr ? "" : path);
        for (std::string folder; std::getline(folders, folder, ':');) {
            folder.append("/").append(name);
            if (access(folder.c_str(), X_OK) == 0) return folder;
        }
    }
    return {};
}

bool openBrowser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
    const std::string opener = findProgram({"xdg-open", "sensible-browser", "x-www-browser"});
    if (opener.empty()) return false;
    // The opener returns, but the browser it starts must outlive us: so nobody waits for it.
    SpawnPlan plan;
    dropOutput(plan);
    posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<std::string> words = {opener, address};
    char* arguments[] = {words[0].data(), words[1].data(), nullptr};
    pid_t pid = 0;
    return posix_spawn(&pid, opener.c_str(), &plan.files, &plan.attributes, arguments, environ) == 0;
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "cairn-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        throw IoError(fmt::format("no temporary folder '{}': {}", pattern, std::strerror(errno)));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace cairn::view
