// Playback at constant perceived speed while what a picture costs, or may cost, changes.
//   playback.h -> [constant_speed.h]
//
// When pictures cost too much the space level goes down, to hold the frame rate; when that
// would be too coarse the frame rate is halved, and as each picture then moves further, the
// time level goes up by one. As costs fall it goes back the same way, up to full quality.
//
// Units   seconds of any clock that does not go back; the budget is the share of the time
//         that pictures may cost: 1 is all of it.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.4.2.
#pragma once

#include <optional>

#include "engine/video/playback.h"

namespace haarmony::video {

struct QualityOptions {
    double fps = 25;         // the frame rate at full quality
    double slowest_fps = 6;  // it is not halved to less than this
    int finest_level = 0;    // the space level at full quality
    int coarsest_level = 0;  // below this the frame rate gives way instead
    double budget = 1;
};

// Which space level and frame rate a budget allows, from measured costs.
class Quality {
  public:
    // Requires: 0 < slowest_fps <= fps, 0 <= coarsest_level <= finest_level, budget >= 0.
    explicit Quality(const QualityOptions& options);

    // What a picture of the present quality cost, in seconds.
    void drawn(double cost_s);
    void set_budget(double budget);

    [[nodiscard]] int space_level() const { return space_level_; }
    [[nodiscard]] double fps() const { return options_.fps / (1 << halvings_); }
    [[nodiscard]] bool full() const {
        return halvings_ == 0 && space_level_ == options_.finest_level;
    }

  private:
    [[nodiscard]] double allowed_s() const { return options_.budget / fps(); }
    void go_coarser();
    void go_finer(double cost_s);
    void start_over() {
        total_s_ = 0;
        pictures_ = 0;
    }

    QualityOptions options_;
    int space_level_;
    int halvings_ = 0;
    double total_s_ = 0;  // of the pictures since the last change
    int pictures_ = 0;
};

struct QualityStep {
    TimeStep time;
    int space_level = 0;
    double until_s = 0;  // when the next one is due
};

class ConstantSpeed {
  public:
    ConstantSpeed(const ClipShape& shape,
                  const PlaybackOptions& playback,
                  const QualityOptions& quality,
                  double now_s)
        : playback_(shape, playback, now_s), quality_(quality), due_s_(now_s) {}

    // What to show now; nothing at the clip's end. A step that is late moves further.
    [[nodiscard]] std::optional<QualityStep> next(double now_s);
    // What the last step cost; a repeated one costs nothing and does not count.
    void drawn(double cost_s);
    void set_budget(double budget) { quality_.set_budget(budget); }
    void set_speed(double speed, double now_s) { playback_.set_speed(speed, now_s); }

    [[nodiscard]] const Playback& playback() const { return playback_; }
    [[nodiscard]] const Quality& quality() const { return quality_; }

  private:
    Playback playback_;
    Quality quality_;
    double due_s_;
    bool counts_ = false;
};

}  // namespace haarmony::video
