/// @file Whether the other threads are asked for help, found out by measuring.
#pragma once

#include <algorithm>
#include <cstdint>

namespace cairn {

/// Help costs where a processor is slow, shared with other programs or not there at all, and no property of the machine
/// tells. So a piece of work that is done again and again, such as a stage of the time step, is now and then done the
/// other way than usual, with help or without, and its time compared with that of the steps before. Where that was
/// faster, it is asked again soon, and where it was faster most of the time, it becomes the usual way. What is done
/// does not depend on it.
class HelpChoice {
  public:
    /// Whether to ask for help this time. To be followed by record().
    bool next() {
        trying_ = --until_trial_ <= 0;
        return helps_ != trying_;
    }

    /// @param time that it took this way [any unit]
    void record(double time) {
        if (!trying_) {
            usual_ = usual_ > 0 ? usual_ + recent * (time - usual_) : time;
            return;
        }
        const double ratio = usual_ > 0 ? time / usual_ : 1;
        score_ += (std::min(ratio, most_ratio) - score_) / 2;
        pause_ = ratio < 1 ? shortest_pause : std::min(2 * pause_, longest_pause);
        until_trial_ = pause_;
        if (!(score_ < clearly_faster)) return;
        helps_ = !helps_;
        usual_ = time;
        score_ = 1 / score_;
    }

  private:
    static constexpr std::int64_t shortest_pause = 8, longest_pause = 256;  ///< times between two trials
    static constexpr double recent = 0.25;                                  ///< weight of the last time
    static constexpr double clearly_faster = 0.9;
    static constexpr double most_ratio = 2;  ///< a disturbance during one trial is not to count for many

    bool helps_ = true;
    bool trying_ = false;
    double usual_ = 0;  ///< mean of the last times the usual way
    double score_ = 1;  ///< mean of the last trials' times as parts of that
    std::int64_t pause_ = shortest_pause;
    std::int64_t until_trial_ = 2 * shortest_pause;
};

}  // namespace cairn
