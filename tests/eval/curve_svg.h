// Curves as SVG, to stand in the page of results.
//   curve_strokes.h -> [curve_svg.h] -> figure_3_4.h ... figure_3_13.h
//
// Shape   one <svg> element, well-formed as XML; Bezier segments are written as such, so that
//         nothing is approximated but the digits (0.01 of a unit of the drawing).
// Units   a view, 360 units wide or as many pixels as wanted, holds the given box.
// Errors  none; a number that is not finite is a caller's bug and asserts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::eval {

// The rectangle of a page that is to be seen.
struct Box {
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
};
// What holds all the curves and `margin` around them. Requires: at least one curve.
[[nodiscard]] Box box_of(const std::vector<curve::Points>& controls, double margin);

// The Bezier segments of an open curve, four rows each.
[[nodiscard]] curve::Points segments_of(const curve::Points& control);

// The point at t in [0, 1] of the segment whose four rows begin at `first`, and its slope.
struct SegmentPoint {
    std::vector<double> place;
    std::vector<double> slope;
};
[[nodiscard]] SegmentPoint segment_point(const curve::Points& bezier,
                                         std::size_t first,
                                         double t);

enum class Ink { kPlain, kFine, kGhost };

class CurveDrawing {
  public:
    // As wide as its column, with a heading.
    CurveDrawing(std::string title, const Box& box);
    // So many pixels wide, whatever the page does; the title is for those who cannot see.
    CurveDrawing(std::string title, const Box& box, int width_px);

    // Open curves. `colour` is 0 .. kPlotColours - 1 (plot_svg.h).
    void curve(const curve::Points& control, int colour, Ink ink);
    // Bezier segments, four rows each.
    void segments(const curve::Points& bezier, int colour, Ink ink);
    // Dots where the segments begin and end.
    void joints(const curve::Points& bezier, int colour);
    // Bezier segments as thick as their third number says, on the page's scale.
    void ribbon(const curve::Points& bezier, int colour);
    void dot(double x, double y, int colour, const std::string& title);
    void arrow(double x, double y, double dx, double dy, int colour);

    [[nodiscard]] std::string svg() const;

  private:
    [[nodiscard]] std::string at(double x, double y) const;

    std::string title_;
    Box box_;
    double scale_ = 1;
    double top_ = 0;
    int width_px_ = 0;  // 0: as wide as its column
    std::string content_;
};

// Drawings of fixed sizes in a row.
[[nodiscard]] std::string in_a_row(const std::vector<std::string>& drawings);

}  // namespace haarmony::eval
