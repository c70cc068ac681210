#include "cli/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace cairn::cli {

namespace {

// A signal handler can reach nothing but a variable of the program.
volatile std::sig_atomic_t caught = 0;

void remember(int) {
    caught = 1;
}

}  // namespace

void ignoreBrokenPipes() {
    std::signal(SIGPIPE, SIG_IGN);
}

void catchInterrupts() {
    struct sigaction action {};
    action.sa_handler = remember;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
    // Whoever started the program with nohup wants it to go on when the terminal is closed.
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() {
    return caught != 0;
}

}  // namespace cairn::cli
