#include "engine/video/panorama.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/video/display.h"
#include "engine/video/mix.h"

namespace haarmony::video {
namespace {

constexpr std::int64_t kYawUnits = 1 << 20;  // to a degree
constexpr std::int64_t kTurn = 360 * kYawUnits;
constexpr std::uint32_t kWhole = std::uint32_t{1} << kWayBits;

std::uint32_t share_of(double part) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(part, 0.0, 1.0) * kWhole));
}

// One axis of a level: its pixels are 2^(L - l) wide, the last one what is left of `length`.
class Axis {
  public:
    Axis(std::int32_t length, int below)
        : length_(length),
          side_(std::ldexp(1.0, below)),
          count_(std::ceil(length / side_)) {}

    // Around a place that may be any number of turns away; pixels count on beyond the seam.
    [[nodiscard]] Between around_turn(double place) const {
        const double turns = std::floor(place / length_);
        const double rest = place - turns * length_;
        const double pixel = std::clamp(std::floor(rest / side_), 0.0, count_ - 1);
        const double first = turns * count_ + (rest < centre(pixel) ? pixel - 1 : pixel);
        const double left = turning_centre(first);
        const double right = turning_centre(first + 1);
        return {static_cast<std::int32_t>(first),
                static_cast<std::int32_t>(first) + 1,
                share_of((right - place) / (right - left))};
    }

    // Around a place in [0, length); the outermost pixels go on outwards.
    [[nodiscard]] Between around(double place) const {
        const double pixel = std::min(std::floor(place / side_), count_ - 1);
        const double first = place < centre(pixel) ? pixel - 1 : pixel;
        const auto row = static_cast<std::int32_t>(first);
        if (first < 0) return {0, 0, kWhole};
        if (first + 1 >= count_) return {row, row, kWhole};
        const double way = (place - centre(first)) / (centre(first + 1) - centre(first));
        return {row, row + 1, share_of(1 - way)};
    }

    [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(count_); }

  private:
    [[nodiscard]] double centre(double pixel) const {
        return (pixel * side_ + std::min((pixel + 1) * side_, length_)) / 2;
    }
    [[nodiscard]] double turning_centre(double pixel) const {
        const double turns = std::floor(pixel / count_);
        return turns * length_ + centre(pixel - turns * count_);
    }

    double length_;
    double side_;
    double count_;
};

// A level of the panorama, as much of it as the view reads.
struct LevelStrip {
    Axis across;
    Axis down;
    std::int32_t left = 0,
                 right = -1;  // pixels read, inclusive; x may lie beyond the seam
    std::int32_t top = 0, bottom = -1;
    Picture picture = {};

    void widen(const Between& columns) {
        const bool empty = right < left;
        left = empty ? columns.first : std::min(left, columns.first);
        right = empty ? columns.second : std::max(right, columns.second);
    }
    void heighten(const Between& rows) {
        const bool empty = bottom < top;
        top = empty ? rows.first : std::min(top, rows.first);
        bottom = empty ? rows.second : std::max(bottom, rows.second);
    }
    [[nodiscard]] Rgba pixel(const Between& columns, const Between& rows) const {
        return mixed({picture.at(columns.first - left, rows.first - top),
                      picture.at(columns.second - left, rows.first - top),
                      picture.at(columns.first - left, rows.second - top),
                      picture.at(columns.second - left, rows.second - top)},
                     columns.weight,
                     rows.weight);
    }
    // Around and around, piece by piece between seams.
    void draw_from(const Frame& frame, int level) {
        if (right < left || bottom < top) return;
        picture = Picture(right - left + 1, bottom - top + 1);
        const std::int32_t turn = across.count();
        for (std::int32_t x = left; x <= right;) {
            const std::int32_t column = (x % turn + turn) % turn;
            const std::int32_t width = std::min(turn - column, right - x + 1);
            draw(frame,
                 level,
                 Edge::kNormalize,
                 {column, top, width, bottom - top + 1},
                 &picture.at(x - left, 0),
                 picture.width);
            x += width;
        }
    }
};

// What one column of the view shows: row Y is at top + Y * step on the cylinder.
struct Column {
    const LevelStrip* finer = nullptr;  // of the two levels that are mixed
    const LevelStrip* coarser = nullptr;
    std::uint32_t weight = 0;  // of the finer one
    Between fine;
    Between coarse;
    double top = 0;
    double step = 0;
};

class View {
  public:
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    View(const ClipShape& shape, const PanoramaView& view)
        : shape_(shape), view_(view), columns_(static_cast<std::size_t>(view.width)) {
        const double degree = std::numbers::pi / 180;
        const double focal = view.width / 2.0 / std::tan(view.fov / 2 * degree);
        const double radius = shape.width() / (2 * std::numbers::pi);
        std::int64_t turned = std::llround(std::fmod(view.yaw, 360) * double{kYawUnits});
        turned = (turned + kTurn) % kTurn;
        const double yaw = static_cast<double>(turned) / double{kTurn};
        const double up = std::tan(view.pitch * degree);
        for (std::int32_t i = 0; i < view.width; ++i) {
            const double x = (i + 0.5 - view.width / 2.0) / focal;
            const double radius_here = radius / std::sqrt(1 + x * x);
            Column& column = columns_[static_cast<std::size_t>(i)];
            column.step = radius_here / focal;
            column.top = shape.height() / 2.0 +
                         radius_here * ((0.5 - view.height / 2.0) / focal - up);
            const double turns = yaw + std::atan(x) / (2 * std::numbers::pi);
            choose_levels(column, shape.width() * turns);
        }
    }

    [[nodiscard]] int finest_level() const { return strips_.rbegin()->first; }

    [[nodiscard]] Picture drawn(const Frame& frame) {
        for (auto& [level, strip] : strips_) strip.draw_from(frame, level);
        Picture picture(view_.width, view_.height);
        for (std::int32_t y = 0; y < view_.height; ++y) {
            for (std::int32_t x = 0; x < view_.width; ++x) {
                picture.at(x, y) = pixel(columns_[static_cast<std::size_t>(x)], y);
            }
        }
        return picture;
    }

  private:
    // As fractional zoom, for a root square that has a pixel where the view has one; rows
    // are the denser way of the two.
    void choose_levels(Column& column, double place) {
        const int finest = shape_.space_levels();
        const double level = finest - std::log2(column.step);
        const int finer = std::clamp(static_cast<int>(std::ceil(level)), 0, finest);
        // (M - h) / h with M = 2^level, h = 2^(finer - 1)
        column.weight = finer == 0 ? kWhole : share_of(std::exp2(level - finer + 1) - 1);
        column.finer = read(column, finer, place, column.fine);
        if (column.weight == kWhole) return;
        column.coarser = read(column, finer - 1, place, column.coarse);
    }

    // Has the level hold what a column reads of it, which begins at `place`.
    const LevelStrip* read(const Column& column,
                           int level,
                           double place,
                           Between& columns) {
        const int below = shape_.space_levels() - level;
        const Axis x(shape_.width(), below);
        const Axis y(shape_.height(), below);
        LevelStrip& strip = strips_.try_emplace(level, LevelStrip{x, y}).first->second;
        columns = x.around_turn(place);
        strip.widen(columns);
        const double last = column.top + (view_.height - 1) * column.step;
        if (last >= 0 && column.top < shape_.height()) {
            const double lowest =
                std::nextafter(static_cast<double>(shape_.height()), 0.0);
            strip.heighten(y.around(std::max(column.top, 0.0)));
            strip.heighten(y.around(std::min(last, lowest)));
        }
        return &strip;
    }

    [[nodiscard]] Rgba pixel(const Column& column, std::int32_t y) const {
        const double place = column.top + y * column.step;
        if (place < 0 || place >= shape_.height()) return kClear;
        const LevelStrip& finer = *column.finer;
        const Rgba fine = finer.pixel(column.fine, finer.down.around(place));
        if (column.weight == kWhole) return fine;
        const LevelStrip& coarser = *column.coarser;
        const Rgba coarse = coarser.pixel(column.coarse, coarser.down.around(place));
        return mixed(fine, coarse, column.weight, kWayBits);
    }

    ClipShape shape_;
    PanoramaView view_;
    std::vector<Column> columns_;
    std::map<int, LevelStrip> strips_;  // whose places columns_ know
};

Result<void> check(const char* name, double value, double least, double most) {
    if (value >= least && value <= most) return {};
    return Error{ErrorCode::kInvalidArgument,
                 std::string(name) + " is " + std::to_string(value) + "; want " +
                     std::to_string(least) + " to " + std::to_string(most),
                 name};
}

Result<void> check(const PanoramaView& view) {
    if (!std::isfinite(view.yaw)) {
        return Error{ErrorCode::kInvalidArgument,
                     "yaw is " + std::to_string(view.yaw) + "; want a finite number",
                     "yaw"};
    }
    if (auto ok = check("pitch", view.pitch, -kLargestPitch, kLargestPitch); !ok)
        return ok;
    if (auto ok = check("fov", view.fov, kLeastFov, kLargestFov); !ok) return ok;
    if (auto ok = check("width", view.width, 1, kLargestView); !ok) return ok;
    return check("height", view.height, 1, kLargestView);
}

}  // namespace

Result<Picture> draw_panorama(const TimeTree& clip,
                              const NodeAddress& at,
                              const PanoramaView& view) {
    assert(clip.shape().contains(at));
    if (Result<void> ok = check(view); !ok) return std::move(ok).error();
    View drawing(clip.shape(), view);
    const Result<Frame> frame = clip.frame(at, drawing.finest_level());
    if (!frame) return frame.error();
    return drawing.drawn(*frame);
}

}  // namespace haarmony::video
