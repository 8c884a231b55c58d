// Painted strokes as pixels: what a query is when it is sent as strokes and not as a picture
// (image search, before resample.h).
//
// Shape   a stroke is the union of its points' discs and of the hulls of neighbouring ones,
//         so caps and joins are round and a width may change along it; one point is a dot.
//         With `fill` it is the closed polygon of its points instead, by the non-zero
//         winding rule, and widths do not count; fewer than three points fill nothing.
// Units   canvas pixels, (0, 0) the upper left corner, pixel (x, y) covering
//         [x, x + 1) x [y, y + 1); a width is a diameter.
// Scale   coverage is exact along x and sampled on kSubRows lines a pixel along y; a stroke
//         covers what lies under it once, however often it crosses itself.
// Errors  check_strokes() refuses what is out of range with kInvalidArgument; painting it
//         nevertheless is a caller's bug and asserts.
// Source  sec. 4.4, the painted query.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"

namespace haarmony::image {

inline constexpr int kMaxCanvasSide = 65535;
inline constexpr int kMaxRasterSide = 256;
inline constexpr int kMaxStrokes = 2'000;
inline constexpr int kMaxStrokePoints = 20'000;  // of all strokes together
inline constexpr int kSubRows = 4;

struct Rgb {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

struct Point {
    float x = 0;
    float y = 0;
};

struct Stroke {
    std::vector<Point> points;  // finite, on the canvas or off it
    std::vector<float> widths;  // finite, >= 0: one, or one for each point; any with fill
    Rgb color;
    bool fill = false;
};

struct StrokePicture {
    int width = 0;  // of the canvas, 1..kMaxCanvasSide
    int height = 0;
    std::optional<Rgb> background;  // nothing: what is not painted is transparent
    std::vector<Stroke> items;      // later ones cover earlier ones
};

struct Raster {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t>
        rgba;  // straight alpha; 0, 0, 0, 0 where nothing is painted

    [[nodiscard]] ImageView view() const {
        return {rgba.data(), width, height, 4, std::ptrdiff_t{4} * width};
    }
};

// Whether the picture can be painted: sides in 1..kMaxCanvasSide, at most kMaxStrokes and
// kMaxStrokePoints, finite numbers, widths not negative and as many as there should be.
[[nodiscard]] Result<void> check_strokes(const StrokePicture& picture);

// A canvas with a side above kMaxRasterSide (two pixels, eight lines, to a cell of the signature) is
// painted smaller, in proportion. Requires: check_strokes() has no objection.
// Cost: a point at most 4 * kMaxRasterSide lines, those outside the canvas none; a stroke
// at most the pixels of the raster.
[[nodiscard]] Raster rasterize(const StrokePicture& picture);

}  // namespace haarmony::image
