// A slider that is pulled through a clip shows all of it on the way.
//   advance.h -> [scrub.h]
//
// Each picture covers what the hand has moved over and has not been shown, as far as one time
// node can: how far that is is the hand's speed times the time since the last picture, so
// that a slow hand sees single frames and a fast one blurred nodes. A hand at rest sees the
// single frame that it points at.
//
// Shape   each node touches or overlaps the one shown before, so that together they cover the
//         way moved over, turning points included.
// Units   positions in frames, 0 .. frames; seconds of any clock that does not go back.
// Errors  none; a position outside the clip is drawn to its nearest end.
// Source  sec. 5.4.3.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/video/advance.h"

namespace haarmony::video {

class Scrub {
  public:
    // A hand that has not moved for `rest_s` is at rest.
    explicit Scrub(const ClipShape& shape, double rest_s = 0.1)
        : shape_(shape), rest_s_(rest_s) {}

    // Where the hand is. Requires: a position that is a number.
    void move(double position, double now_s);
    // What to show now; nothing before the first move, or if what is shown will do.
    [[nodiscard]] std::optional<NodeAddress> next(double now_s);
    // Whether a part of the way has not been shown.
    [[nodiscard]] bool behind() const;

  private:
    NodeAddress show(const NodeAddress& node);

    ClipShape shape_;
    double rest_s_;
    bool held_ = false;  // moved at all
    std::int64_t hand_ = 0;
    double moved_s_ = 0;
    // Where the hand has been that is not yet shown: hand_ lies within.
    std::int64_t lowest_ = 0;
    std::int64_t highest_ = 0;
    std::optional<NodeAddress> last_;
    FrameRange shown_;
};

}  // namespace haarmony::video
