#include "server/api/video_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/video/display.h"
#include "engine/video/shutter.h"
#include "server/api/points_json.h"

namespace haarmony::server {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{64} << 20;
// Fractions that name a pixel's edge may be a rounding away from it.
constexpr double kRounding = 1e-9;

constexpr std::array<std::string_view, 2> kEdges{"normalize", "pad"};

std::optional<std::int64_t> whole(Inputs& inputs, std::string_view name) {
    return inputs.integer(name,
                          std::numeric_limits<std::int64_t>::min(),
                          std::numeric_limits<std::int64_t>::max());
}

std::optional<double> real(Inputs& inputs, std::string_view name) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return inputs.number(name, -kMost, kMost);
}

http::Problem outside(std::string_view name,
                      const std::string& value,
                      std::string range) {
    return impossible(
        "out_of_range",
        std::string(name) + " '" + value + "' is outside the clip: " + std::move(range),
        name);
}

http::Problem outside(std::string_view name,
                      std::int64_t value,
                      std::int64_t least,
                      std::int64_t most) {
    return outside(name,
                   std::to_string(value),
                   std::to_string(least) + " to " + std::to_string(most));
}

// When.
struct Moment {
    video::FrameRange frames;
    std::optional<video::NodeAddress> node;
};

Moment moment_of(const video::ClipShape& shape, const video::NodeAddress& at) {
    return {shape.frames_of(at), at};
}

Outcome<Moment> moment_of_node(const video::ClipShape& shape, const VideoPlace& place) {
    if (!place.index)
        return impossible("no_time", "index is missing beside time_level", "index");
    if (!place.time_level)
        return impossible("no_time", "time_level is missing beside index", "time_level");
    if (*place.time_level < 0 || *place.time_level > shape.time_levels())
        return outside("time_level", *place.time_level, 0, shape.time_levels());
    const auto level = static_cast<int>(*place.time_level);
    if (*place.index < 0 || *place.index >= shape.nodes_at(level))
        return outside("index", *place.index, 0, shape.nodes_at(level) - 1);
    return moment_of(shape, {level, *place.index});
}

Outcome<Moment> moment_of_time(const video::ClipShape& shape, const VideoPlace& place) {
    const double rate = shape.rate().per_second();
    const double first = std::floor(*place.time * rate);
    if (!(first >= 0 && first < static_cast<double>(shape.frames())))
        return outside("time",
                       number_text(*place.time),
                       "0 up to, not including, " +
                           number_text(static_cast<double>(shape.frames()) / rate));
    const auto frame = static_cast<std::int64_t>(first);
    if (!place.shutter) return moment_of(shape, {shape.time_levels(), frame});
    if (!(*place.shutter >= 0))
        return impossible("out_of_range",
                          "shutter '" + number_text(*place.shutter) + "' is negative",
                          "shutter");
    // Frames that are open for a part of the time count as open.
    const double end = std::ceil((*place.time + *place.shutter) * rate - kRounding);
    Moment moment;
    moment.frames = {frame,
                     end >= static_cast<double>(shape.frames())
                         ? shape.frames()
                         : std::max(frame + 1, static_cast<std::int64_t>(end))};
    moment.node = node_of(shape, moment.frames);
    return moment;
}

Outcome<Moment> moment_at(const video::TimeTree& clip, const VideoPlace& place) {
    const video::ClipShape& shape = clip.shape();
    if (place.time_level || place.index) return moment_of_node(shape, place);
    if (place.time) return moment_of_time(shape, place);
    if (!place.frame)
        return impossible(
            "no_time", "no time is given: time_level and index, frame, or time", "time");
    if (*place.frame < 0 || *place.frame >= shape.frames())
        return outside("frame", *place.frame, 0, shape.frames() - 1);
    return moment_of(shape, {shape.time_levels(), *place.frame});
}

// How large the cropped picture is: at a level as it is, or with the root square that wide.
struct Size {
    int level = 0;
    std::optional<std::int32_t> root_side;
    std::int64_t width = 0;
    std::int64_t height = 0;
};

Size size_of_root(const video::ClipShape& shape, std::int64_t root_side) {
    Size size;
    size.root_side = static_cast<std::int32_t>(root_side);
    size.width = video::zoomed_width(shape, *size.root_side);
    size.height = video::zoomed_height(shape, *size.root_side);
    return size;
}

Outcome<Size> size_of_width(const video::ClipShape& shape, std::int64_t width) {
    const auto root_side = video::root_side_for_width(shape, width);
    if (!root_side) return impossible(root_side.error());
    Size size = size_of_root(shape, *root_side);
    // The rounding of the root square may have made room for one more.
    size.width = std::min(size.width, width);
    return size;
}

Outcome<Size> size_at(const video::ClipShape& shape, const VideoPlace& place) {
    if (place.width) return size_of_width(shape, *place.width);
    const double level = place.level.value_or(shape.space_levels());
    if (!(level >= 0 && level <= shape.space_levels()))
        return outside(
            "level", number_text(level), "0 to " + std::to_string(shape.space_levels()));
    const double below = std::floor(level);
    if (level != below) return size_of_root(shape, std::llround(std::exp2(level)));
    Size size;
    size.level = static_cast<int>(below);
    size.width = shape.width_at(size.level);
    size.height = shape.height_at(size.level);
    return size;
}

// A side of the region, outward to whole pixels: [first, end).
struct Side {
    std::int32_t first = 0;
    std::int32_t end = 0;
};

Outcome<Side> side_of(std::optional<double> from,
                      std::optional<double> extent,
                      std::int64_t pixels,
                      std::string_view from_name,
                      std::string_view extent_name) {
    const double first = from.value_or(0);
    if (!(first >= 0 && first < 1))
        return impossible("out_of_range",
                          std::string(from_name) + " '" + number_text(first) +
                              "' is not in the picture: 0 up to, not including, 1",
                          from_name);
    const double length = extent.value_or(1 - first);
    if (!(length > 0 && first + length <= 1 + kRounding))
        return impossible("out_of_range",
                          std::string(extent_name) + " '" + number_text(length) +
                              "' is nothing, or reaches out of the picture",
                          extent_name);
    const auto size = static_cast<double>(pixels);
    Side side;
    side.first = static_cast<std::int32_t>(
        std::clamp(std::floor(first * size + kRounding), 0.0, size - 1));
    side.end = static_cast<std::int32_t>(std::clamp(
        std::ceil((first + length) * size - kRounding), side.first + 1.0, size));
    return side;
}

bool more_than_one(const VideoPlace& place) {
    const int ways = (place.time_level || place.index ? 1 : 0) + (place.frame ? 1 : 0) +
                     (place.time ? 1 : 0);
    return ways > 1;
}

}  // namespace

VideoPlace read_video_place(Inputs& inputs) {
    VideoPlace place;
    if (!inputs.has("video")) inputs.refuse("video", "is missing");
    place.video =
        inputs.integer("video", 1, std::numeric_limits<std::int64_t>::max()).value_or(0);
    place.time_level = whole(inputs, "time_level");
    place.index = whole(inputs, "index");
    place.frame = whole(inputs, "frame");
    place.time = real(inputs, "time");
    place.shutter = real(inputs, "shutter");
    place.half_blur = inputs.boolean("half_blur").value_or(false);
    place.level = real(inputs, "level");
    place.width = whole(inputs, "width");
    place.x = real(inputs, "x");
    place.y = real(inputs, "y");
    place.w = real(inputs, "w");
    place.h = real(inputs, "h");
    place.edge = inputs.one_of("edge", kEdges) == "pad" ? video::Edge::kPad
                                                        : video::Edge::kNormalize;
    place.smooth = inputs.boolean("smooth").value_or(false);
    const auto contradicts = [&inputs](std::string_view name, std::string detail) {
        inputs.refuse(malformed(std::move(detail), name));
    };
    if (more_than_one(place))
        contradicts(place.time ? "time" : "frame",
                    "a time is given more than once: time_level and index, frame, and "
                    "time exclude each other");
    if (place.shutter && !place.time) contradicts("shutter", "shutter belongs to time");
    if (place.shutter && place.half_blur)
        contradicts("half_blur", "half_blur and shutter exclude each other");
    if (place.level && place.width)
        contradicts("width", "level and width exclude each other");
    return place;
}

Outcome<VideoPicture> picture_at(const video::TimeTree& clip, const VideoPlace& place) {
    const video::ClipShape& shape = clip.shape();
    auto moment = moment_at(clip, place);
    if (!moment) return moment.problem();
    if (place.half_blur)
        *moment = moment_of(shape, video::half_blur(clip, *moment->node));
    auto size = size_at(shape, place);
    if (!size) return size.problem();
    auto across = side_of(place.x, place.w, size->width, "x", "w");
    if (!across) return across.problem();
    auto down = side_of(place.y, place.h, size->height, "y", "h");
    if (!down) return down.problem();
    VideoPicture picture;
    picture.frames = moment->frames;
    picture.node = moment->node;
    picture.level = size->level;
    picture.root_side = size->root_side;
    picture.box = {
        across->first, down->first, across->end - across->first, down->end - down->first};
    picture.edge = place.edge;
    picture.finer = place.smooth ? video::Finer::kSmooth : video::Finer::kFlat;
    if (std::int64_t{picture.box.width} * picture.box.height > kMostPixels)
        return http::Problem{413,
                             "too_large",
                             std::to_string(picture.box.width) + " x " +
                                 std::to_string(picture.box.height) +
                                 " pixels are more than " + std::to_string(kMostPixels),
                             place.width ? "width" : "level",
                             {}};
    return picture;
}

}  // namespace haarmony::server
