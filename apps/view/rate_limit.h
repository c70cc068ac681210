/// @file How many messages a viewer may send.
#pragma once

#include <algorithm>

namespace cairn::view {

/// A bucket that fills with time and is emptied by messages.
class RateLimit {
  public:
    /// @param per_second messages in the long run @param burst messages at once
    RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

    /// @param seconds a clock's time @return false if the message is one too many
    bool take(double seconds) {
        left_ = std::min(burst_, left_ + std::max(0.0, seconds - last_) * per_second_);
        last_ = seconds;
        if (left_ < 1) return false;
        left_ -= 1;
        return true;
    }

  private:
    double per_second_;
    double burst_;
    double left_;
    double last_ = 0;
};

}  // namespace cairn::view
