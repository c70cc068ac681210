#include "cli/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace cairn::test {

namespace {

std::string readWhole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void redirect(int stream, const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (descriptor < 0 || dup2(descriptor, stream) < 0) _exit(126);
}

}  // namespace

Program::Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments, const std::string& out)
    : out_(out.empty() ? folder / "stdout" : std::filesystem::path(out)), error_(folder / "stderr") {
    std::vector<std::string> words{CAIRN_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    id_ = fork();
    if (id_ < 0) throw std::runtime_error("no process can be made");
    if (id_ == 0) {
        // The tests may have been started with nohup, which a program inherits.
        signal(SIGHUP, SIG_DFL);
        redirect(STDOUT_FILENO, out_);
        redirect(STDERR_FILENO, error_);
        if (chdir(folder.c_str()) == 0) execv(pointers[0], pointers.data());
        _exit(127);
    }
}

Program::~Program() {
    if (id_ <= 0) return;
    send(SIGKILL);
    waitpid(id_, nullptr, 0);
}

void Program::send(int signal) const {
    kill(id_, signal);
}

Finished Program::finish() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    const bool regular = std::filesystem::is_regular_file(out_);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, regular ? readWhole(out_) : "", readWhole(error_)};
}

Finished runProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                    const std::string& out) {
    return Program(folder, arguments, out).finish();
}

}  // namespace cairn::test
