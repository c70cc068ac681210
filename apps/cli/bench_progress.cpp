#include "cli/bench_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "cli/output.h"

namespace cairn::cli {

BenchProgress::BenchProgress() : shown_(isatty(STDERR_FILENO) == 1) {}

BenchProgress::~BenchProgress() {
    if (shown_) printLine(stderr, "");
}

void BenchProgress::update(double part, const std::string& what) {
    const auto now = Clock::now();
    if (!shown_ || now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    constexpr int width = 30;
    const int filled = static_cast<int>(part * width);
    fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} %  {}", "", filled, "", width - filled, 100 * part, what);
    std::fflush(stderr);
}

}  // namespace cairn::cli
