#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cairn::cli {

namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds pause{100};
constexpr const char* clear_line = "\r\033[K";

std::string clockTime(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(double duration, Wish wish)
    : duration_(duration), shown_(wish == Wish::show && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_) fmt::print(stderr, "{}", clear_line);
}

void Progress::update(double time) {
    const auto now = Clock::now();
    if (!shown_ || now < next_ || !(time > 0)) return;
    next_ = now + pause;
    const double wall = std::max(1e-9, std::chrono::duration<double>(now - begin_).count());
    const double part = std::min(1.0, time / duration_);
    const int filled = static_cast<int>(part * bar_width);
    fmt::print(stderr, "{}[{}{}] {:.2f} of {:.2f} s, {:.2f} times real time, {} left", clear_line,
               std::string(static_cast<std::size_t>(filled), '#'),
               std::string(static_cast<std::size_t>(bar_width - filled), '.'), time, duration_, time / wall,
               clockTime(wall * (1 - part) / part));
    std::fflush(stderr);
}

}  // namespace cairn::cli
