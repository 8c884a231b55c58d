// A view out of a cylindrical panorama whose pictures are periodic in x.
//   display.h, mix.h -> [panorama.h]
//
// The picture is the inside of a cylinder of which its width is 360 degrees and its middle row
// the horizon. It is seen on an upright plane that is pushed up or down by the pitch and not
// tilted, as with a shift lens: each column looks in one direction, so verticals stay
// vertical.
//
// Shape   row-major; above and below the cylinder the view is clear.
// Units   degrees; yaw 0 looks at the left edge and grows to the right, pitch grows upwards,
//         fov is the view's width. The yaw is reduced modulo 360 and rounded to 2^-20
//         degrees: yaws that differ by whole turns give the same bytes.
// Scale   as fractional zoom: at each column the two levels around its sampling density,
//         bilinear in each, mixed premultiplied.
// Errors  kInvalidArgument naming the parameter; what the clip's storage meets.
// Cost    proportional to the pixels of the view.
// Source  sec. 5.4.5; [Che95].
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

inline constexpr double kLeastFov = 0.01;
inline constexpr double kLargestFov = 150;
inline constexpr double kLargestPitch = 75;
inline constexpr std::int32_t kLargestView = 1 << 14;

struct PanoramaView {
    double yaw = 0;
    double pitch = 0;  // -kLargestPitch .. kLargestPitch
    double fov = 90;   // kLeastFov .. kLargestFov
    std::int32_t width = 0;
    std::int32_t height = 0;
};

// Requires: clip.shape().contains(at).
[[nodiscard]] Result<Picture> draw_panorama(const TimeTree& clip,
                                            const NodeAddress& at,
                                            const PanoramaView& view);

}  // namespace haarmony::video
