#include "engine/image/canvas.h"

#include <algorithm>
#include <cmath>

namespace haarmony::image {
namespace {

std::array<float, 4> layer(const Rgb& color, float share) {
    return {float(color.red) / 255.0F * share,
            float(color.green) / 255.0F * share,
            float(color.blue) / 255.0F * share,
            share};
}

std::uint8_t to_byte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

}  // namespace

RowCover::RowCover(int width)
    : width_(width),
      step_(std::size_t(width) + 1),
      edge_(std::size_t(width) + 1),
      touched_begin_(step_.size()) {}

int RowCover::to_units(double x) const {
    return static_cast<int>(std::lround(std::clamp(x, 0.0, double(width_)) * kSubPixel));
}

void RowCover::add(const Span& span) {
    const int begin = to_units(span.begin);
    const int end = to_units(span.end);
    const std::size_t first = std::size_t(begin) / kSubPixel;
    const std::size_t last = std::size_t(end) / kSubPixel;
    step_[first] += kSubPixel;
    step_[last] -= kSubPixel;
    edge_[first] -= begin % kSubPixel;
    edge_[last] += end % kSubPixel;
    touched_begin_ = std::min(touched_begin_, first);
    touched_end_ = std::max(touched_end_, last + 1);
}

void RowCover::clear() {
    for (std::size_t x = touched_begin_; x < touched_end_; ++x) step_[x] = edge_[x] = 0;
    touched_begin_ = step_.size();
    touched_end_ = 0;
}

Canvas::Canvas(int width, int height, const std::optional<Rgb>& background)
    : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {
    if (background) std::ranges::fill(pixels_, layer(*background, 1.0F));
}

void Canvas::paint(std::size_t x, int y, const Rgb& color, int cover) {
    const float share = static_cast<float>(cover) / float{kFullCover};
    const std::array<float, 4> above = layer(color, share);
    std::array<float, 4>& pixel = pixels_[std::size_t(y) * std::size_t(width_) + x];
    for (std::size_t c = 0; c < 4; ++c) pixel[c] = above[c] + (1.0F - share) * pixel[c];
}

std::vector<std::uint8_t> Canvas::straight() const {
    std::vector<std::uint8_t> rgba;
    rgba.reserve(pixels_.size() * 4);
    for (const std::array<float, 4>& pixel : pixels_) {
        const std::uint8_t alpha = to_byte(pixel[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            rgba.push_back(alpha > 0 ? to_byte(pixel[c] / pixel[3]) : std::uint8_t{0});
        }
        rgba.push_back(alpha);
    }
    return rgba;
}

}  // namespace haarmony::image
