// A clip played at any speed: which time node to show when, by a clock that is passed in.
//   advance.h -> [playback.h] -> constant_speed.h
//
// Faster than its frames are shown a clip is motion-blurred: two adjacent time levels
// alternate so that the perceived speed is exact over time. Slower than that, frames stay for
// several steps or, as an option, are mixed with the next ones.
//
// Units   seconds of any clock that does not go back; frames of the clip; speed 1 is the
//         clip's own pace, below 0 goes backwards.
// Scale   after a step the front differs from where the clip should then be by less than a
//         step: what lay between the two before it, or what the clip moves by in a period, or
//         a frame. No frame is left out.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.4.1, 5.4.2; sec. 5.6 ["the motion is choppy"].
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/result.h"
#include "engine/video/advance.h"
#include "engine/video/display.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

inline constexpr int kTimeBits = 8;

// One picture of a clip that is played: a time node, or two frames mixed.
struct TimeStep {
    NodeAddress at;
    // Where frames are smoothed in time: mixed with this one.
    std::optional<NodeAddress> next;
    std::uint32_t weight = 1U << kTimeBits;  // of `at`, in 1 / 2^kTimeBits
    bool repeated = false;                   // the picture of the step before

    friend bool operator==(const TimeStep&, const TimeStep&) = default;
};

struct PlaybackOptions {
    double position = 0;  // in frames: forwards from here on, or backwards
    double speed = 1;     // any finite number
    // Where the clip goes slower than the steps, what is shown goes on between the frames.
    bool smooth_in_time = false;
};

class Playback {
  public:
    // Requires: 0 <= position <= frames.
    Playback(const ClipShape& shape, const PlaybackOptions& options, double now_s);

    // What to show from now on for `period_s`; nothing once the clip's end was shown.
    // Requires: period_s > 0; now_s does not go back.
    [[nodiscard]] std::optional<TimeStep> next(double now_s, double period_s);
    void set_speed(double speed, double now_s);

    // Where the clip should be: 0 .. frames.
    [[nodiscard]] double position(double now_s) const;
    // Parts what was shown from what was not.
    [[nodiscard]] std::int64_t front() const { return front_; }
    [[nodiscard]] double speed() const { return speed_; }

  private:
    [[nodiscard]] Direction direction() const {
        return speed_ < 0 ? Direction::kBackwards : Direction::kForwards;
    }
    // Both: `move` is what the clip moves by in this step.
    [[nodiscard]] std::optional<TimeStep> blurred(double position, double move);
    [[nodiscard]] std::optional<TimeStep> single(double position, double move);
    [[nodiscard]] TimeStep between_frames(double position) const;
    TimeStep show(TimeStep step);

    ClipShape shape_;
    bool smooth_in_time_;
    double speed_;
    double anchor_position_;
    double anchor_s_;
    std::int64_t front_;
    std::optional<TimeStep> last_;
};

// A step's picture, drawn as zoom() does. Errors: what the clip's storage meets.
// Requires: as zoom().
[[nodiscard]] Result<Picture> zoom_step(const TimeTree& clip,
                                        const TimeStep& step,
                                        std::int32_t root_side,
                                        Edge edge,
                                        const PixelBox& box,
                                        Finer finer = Finer::kFlat);

}  // namespace haarmony::video
