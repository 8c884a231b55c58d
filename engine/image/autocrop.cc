#include "engine/image/autocrop.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace haarmony::image {
namespace {

// Levels of 255 that a pixel of a border may be off: what JPEG leaves beside an edge.
constexpr int kPixelTolerance = 24;
// Of the mean of a line, which noise leaves alone and the gradient of a sky does not.
constexpr double kMeanTolerance = 3.0;
constexpr double kOutliers = 0.02;
// A border ends where a line is as different as this, at most one block of subsampled chroma
// beyond the last line that is like the first: so far does an edge ring in a JPEG. But no
// border rings further than it is wide, or a photograph's first line alone would be one.
constexpr double kEdgeShare = 0.25;
constexpr int kRinging = 16;
constexpr double kLargestBorder = 0.45;

// Premultiplied, so that all that is transparent is one colour.
using Color = std::array<int, 4>;

Color color_at(const ImageView& picture, int x, int y) {
    const std::uint8_t* pixel = picture.row(y) + std::ptrdiff_t{x} * picture.channels;
    if (picture.channels == 1) return {pixel[0], pixel[0], pixel[0], 255};
    if (picture.channels == 3) return {pixel[0], pixel[1], pixel[2], 255};
    const int alpha = pixel[3];
    return {
        pixel[0] * alpha / 255, pixel[1] * alpha / 255, pixel[2] * alpha / 255, alpha};
}

enum class Side { kTop, kBottom, kLeft, kRight };

// The lines of a box from one side inwards, each from its first pixel to its last.
class Lines {
  public:
    Lines(const ImageView& picture, const CropBox& box, Side side)
        : picture_(picture), box_(box), side_(side) {}

    [[nodiscard]] int count() const { return is_row() ? box_.height : box_.width; }
    [[nodiscard]] int length() const { return is_row() ? box_.width : box_.height; }

    [[nodiscard]] Color at(int line, int position) const {
        switch (side_) {
            case Side::kTop:
                return color_at(picture_, box_.x + position, box_.y + line);
            case Side::kBottom:
                return color_at(
                    picture_, box_.x + position, box_.y + box_.height - 1 - line);
            case Side::kLeft:
                return color_at(picture_, box_.x + line, box_.y + position);
            case Side::kRight:
                break;
        }
        return color_at(picture_, box_.x + box_.width - 1 - line, box_.y + position);
    }

  private:
    [[nodiscard]] bool is_row() const {
        return side_ == Side::kTop || side_ == Side::kBottom;
    }

    const ImageView& picture_;
    CropBox box_;
    Side side_;
};

std::array<double, 4> mean_of(const Lines& lines, int line) {
    std::array<double, 4> sum{};
    for (int i = 0; i < lines.length(); ++i) {
        const Color color = lines.at(line, i);
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += color[c];
    }
    for (double& value : sum) value /= lines.length();
    return sum;
}

// The share of a line's pixels that are not of the border's colour.
double share_off(const Lines& lines, int line, const std::array<double, 4>& border) {
    int off = 0;
    for (int i = 0; i < lines.length(); ++i) {
        const Color color = lines.at(line, i);
        bool is_off = false;
        for (std::size_t c = 0; c < color.size(); ++c) {
            is_off = is_off || std::fabs(color[c] - border[c]) > kPixelTolerance;
        }
        off += is_off ? 1 : 0;
    }
    return static_cast<double>(off) / lines.length();
}

bool is_border(const Lines& lines, int line, const std::array<double, 4>& border) {
    const std::array<double, 4> mean = mean_of(lines, line);
    for (std::size_t c = 0; c < mean.size(); ++c) {
        if (std::fabs(mean[c] - border[c]) > kMeanTolerance) return false;
    }
    return share_off(lines, line, border) <= kOutliers;
}

// How many lines of the side are border.
int border_lines(const Lines& lines) {
    const int most = static_cast<int>(kLargestBorder * lines.count());
    const std::array<double, 4> border = mean_of(lines, 0);
    int depth = 0;
    while (depth <= most && is_border(lines, depth, border)) ++depth;
    if (depth == 0 || depth > most) return 0;
    const int reach = depth + std::min(depth, kRinging);
    for (int line = depth; line < std::min(reach, lines.count()); ++line) {
        if (share_off(lines, line, border) >= kEdgeShare) return line;
    }
    return 0;
}

}  // namespace

std::optional<CropBox> content_box(const ImageView& picture) {
    assert(picture.pixels != nullptr && picture.width >= 1 && picture.height >= 1);
    assert(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
    const CropBox whole{0, 0, picture.width, picture.height};
    const int top = border_lines(Lines(picture, whole, Side::kTop));
    const int bottom = border_lines(Lines(picture, whole, Side::kBottom));
    // Columns only within the rows that are left: bars of another colour do not hide them.
    const CropBox rows{0, top, picture.width, picture.height - top - bottom};
    const int left = border_lines(Lines(picture, rows, Side::kLeft));
    const int right = border_lines(Lines(picture, rows, Side::kRight));
    const CropBox box{left, top, picture.width - left - right, rows.height};
    if (box == whole) return std::nullopt;
    return box;
}

ImageView cropped(const ImageView& picture, const CropBox& box) {
    assert(box.x >= 0 && box.y >= 0 && box.width >= 1 && box.height >= 1);
    assert(box.x + box.width <= picture.width && box.y + box.height <= picture.height);
    ImageView view = picture;
    view.pixels = picture.row(box.y) + std::ptrdiff_t{box.x} * picture.channels;
    view.width = box.width;
    view.height = box.height;
    return view;
}

}  // namespace haarmony::image
