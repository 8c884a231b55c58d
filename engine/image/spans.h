// Where horizontal lines cross the two shapes that strokes are made of (strokes.h).
//
// Units   raster pixels; a span is [begin, end] along x.
// Errors  none.
#pragma once

#include <array>
#include <vector>

namespace haarmony::image {

struct Vec2 {
    double x = 0;
    double y = 0;
};

struct Disc {
    Vec2 center;
    double radius = 0;
};

struct Span {
    double begin = 0;
    double end = 0;
    [[nodiscard]] bool empty() const { return !(begin < end); }
};

// The convex hull of two discs: one piece of a stroke with round ends.
class DiscHull {
  public:
    DiscHull(const Disc& a, const Disc& b);

    [[nodiscard]] double top() const { return top_; }
    [[nodiscard]] double bottom() const { return bottom_; }
    // A convex shape meets a line once.
    [[nodiscard]] Span at(double y) const;

  private:
    struct Side {
        Vec2 from;
        Vec2 to;
    };
    std::array<Disc, 2> discs_;
    std::array<Side, 2> sides_;  // the common tangents
    int side_count_ = 0;         // none where one disc holds the other
    double top_;
    double bottom_;
};

// Spans that may overlap, as spans that do not, from left to right. Reorders `spans`.
[[nodiscard]] std::vector<Span> united(std::vector<Span>& spans);

// A crossing of a line with an edge of a polygon: where, and whether the edge goes down
// (+1) or up (-1).
struct Crossing {
    double x = 0;
    int direction = 0;
};

// The spans inside by the non-zero winding rule. Reorders the crossings.
[[nodiscard]] std::vector<Span> spans_of(std::vector<Crossing>& crossings);

}  // namespace haarmony::image
