#include "engine/image/strokes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "engine/image/canvas.h"
#include "engine/image/spans.h"

namespace haarmony::image {
namespace {

// The lines on which coverage is sampled: line i lies at (i + 1/2) / kSubRows.
double line_y(int line) { return (line + 0.5) / kSubRows; }

// The first line at or below y, within [0, lines].
int first_line(double y, int lines) {
    const double line = std::ceil(y * kSubRows - 0.5);
    return static_cast<int>(std::clamp(line, 0.0, double(lines)));
}

// The lines that a piece of a shape meets.
struct Extent {
    int first_line = 0;
    int end_line = 0;
    std::size_t item = 0;
};

// Calls visit(line, item) for every item on every line that it meets, and end_line(line)
// after the last of a line; lines rise, and those that nothing meets are skipped.

template <typename Visit, typename EndLine>
void sweep(std::vector<Extent> extents, const Visit& visit, const EndLine& end_line) {
    std::erase_if(extents, [](const Extent& e) { return e.first_line >= e.end_line; });
    std::ranges::sort(extents, {}, &Extent::first_line);
    std::vector<Extent> active;
    std::size_t next = 0;
    int line = 0;
    while (next < extents.size() || !active.empty()) {
        if (active.empty()) line = extents[next].first_line;
        while (next < extents.size() && extents[next].first_line <= line) {
            active.push_back(extents[next++]);
        }
        for (const Extent& extent : active) visit(line, extent.item);
        end_line(line);
        ++line;
        std::erase_if(active, [line](const Extent& e) { return e.end_line <= line; });
    }
}

// One stroke, in raster pixels.
struct Shape {
    std::vector<Disc> discs;
    Rgb color;
    bool fill = false;
};

std::vector<DiscHull> hulls_of(const std::vector<Disc>& discs) {
    std::vector<DiscHull> hulls;
    if (discs.size() == 1) hulls.emplace_back(discs[0], discs[0]);
    for (std::size_t i = 1; i < discs.size(); ++i) {
        hulls.emplace_back(discs[i - 1], discs[i]);
    }
    return hulls;
}

// Calls add(line, span) for disjoint spans, lines rising.
template <typename Add>
void sweep_outline(const Shape& shape, int lines, const Add& add) {
    const std::vector<DiscHull> hulls = hulls_of(shape.discs);
    std::vector<Extent> extents;
    for (std::size_t i = 0; i < hulls.size(); ++i) {
        extents.push_back(
            {first_line(hulls[i].top(), lines), first_line(hulls[i].bottom(), lines), i});
    }
    std::vector<Span> spans;
    sweep(
        std::move(extents),
        [&](int line, std::size_t item) {
            const Span span = hulls[item].at(line_y(line));
            if (!span.empty()) spans.push_back(span);
        },
        [&](int line) {
            for (const Span& span : united(spans)) add(line, span);
            spans.clear();
        });
}

template <typename Add>
void sweep_polygon(const Shape& shape, int lines, const Add& add) {
    const std::size_t count = shape.discs.size();
    std::vector<Extent> extents;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = shape.discs[i].center.y;
        const double b = shape.discs[(i + 1) % count].center.y;
        extents.push_back(
            {first_line(std::min(a, b), lines), first_line(std::max(a, b), lines), i});
    }
    std::vector<Crossing> crossings;
    sweep(
        std::move(extents),
        [&](int line, std::size_t item) {
            const Vec2 a = shape.discs[item].center;
            const Vec2 b = shape.discs[(item + 1) % count].center;
            const double share = (line_y(line) - a.y) / (b.y - a.y);
            crossings.push_back({a.x + share * (b.x - a.x), a.y < b.y ? +1 : -1});
        },
        [&](int line) {
            for (const Span& span : spans_of(crossings)) add(line, span);
            crossings.clear();
        });
}

void paint(const Shape& shape, RowCover& row_cover, Canvas& canvas) {
    constexpr int kNoRow = -1;
    int row = kNoRow;
    const auto flush = [&] {
        row_cover.flush(
            [&](std::size_t x, int cover) { canvas.paint(x, row, shape.color, cover); });
    };
    const auto add = [&](int line, const Span& span) {
        if (row != line / kSubRows) {
            if (row != kNoRow) flush();
            row = line / kSubRows;
        }
        row_cover.add(span);
    };
    const int lines = canvas.height() * kSubRows;
    if (shape.fill) {
        sweep_polygon(shape, lines, add);
    } else {
        sweep_outline(shape, lines, add);
    }
    if (row != kNoRow) flush();
}

Shape scaled(const Stroke& stroke, double scale) {
    Shape shape{{}, stroke.color, stroke.fill};
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        double radius = 0;
        if (!stroke.fill) {
            radius = stroke.widths[stroke.widths.size() == 1 ? 0 : i] * scale / 2;
        }
        const Point& point = stroke.points[i];
        shape.discs.push_back({{point.x * scale, point.y * scale}, radius});
    }
    return shape;
}

Error invalid(std::string message) {
    return Error{ErrorCode::kInvalidArgument, std::move(message), "strokes"};
}

std::string in_stroke(std::size_t stroke) {
    return " in stroke " + std::to_string(stroke);
}

std::optional<Error> check_side(const char* name, int side) {
    if (side >= 1 && side <= kMaxCanvasSide) return std::nullopt;
    return invalid(std::string(name) + " " + std::to_string(side) + " is outside 1.." +
                   std::to_string(kMaxCanvasSide));
}

std::optional<Error> check_numbers(const Stroke& stroke, std::size_t number) {
    for (const Point& point : stroke.points) {
        for (const float value : {point.x, point.y}) {
            if (!std::isfinite(value)) {
                return invalid("coordinate " + std::to_string(value) + in_stroke(number) +
                               " is not finite");
            }
        }
    }
    if (stroke.fill || stroke.points.empty()) return std::nullopt;
    if (stroke.widths.size() != 1 && stroke.widths.size() != stroke.points.size()) {
        return invalid(std::to_string(stroke.widths.size()) + " widths for " +
                       std::to_string(stroke.points.size()) + " points" +
                       in_stroke(number));
    }
    for (const float width : stroke.widths) {
        if (!(width >= 0) || !std::isfinite(width)) {
            return invalid("width " + std::to_string(width) + in_stroke(number) +
                           " is not a finite number of at least 0");
        }
    }
    return std::nullopt;
}

int raster_side(int side, double scale) {
    return std::max(1, static_cast<int>(std::lround(side * scale)));
}

}  // namespace

Result<void> check_strokes(const StrokePicture& picture) {
    if (auto error = check_side("width", picture.width)) return *std::move(error);
    if (auto error = check_side("height", picture.height)) return *std::move(error);
    if (picture.items.size() > std::size_t{kMaxStrokes}) {
        return invalid(std::to_string(picture.items.size()) + " strokes, at most " +
                       std::to_string(kMaxStrokes));
    }
    std::size_t points = 0;
    for (std::size_t i = 0; i < picture.items.size(); ++i) {
        points += picture.items[i].points.size();
        if (auto error = check_numbers(picture.items[i], i)) return *std::move(error);
    }
    if (points > std::size_t{kMaxStrokePoints}) {
        return invalid(std::to_string(points) + " points, at most " +
                       std::to_string(kMaxStrokePoints));
    }
    return {};
}

Raster rasterize(const StrokePicture& picture) {
    assert(check_strokes(picture));
    const double largest = std::max(picture.width, picture.height);
    const double scale = std::min(1.0, kMaxRasterSide / largest);

    Canvas canvas(raster_side(picture.width, scale),
                  raster_side(picture.height, scale),
                  picture.background);
    RowCover row_cover(canvas.width());
    for (const Stroke& stroke : picture.items) {
        paint(scaled(stroke, scale), row_cover, canvas);
    }
    return {canvas.width(), canvas.height(), canvas.straight()};
}

}  // namespace haarmony::image
