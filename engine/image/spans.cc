#include "engine/image/spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haarmony::image {

DiscHull::DiscHull(const Disc& a, const Disc& b)
    : discs_{a, b},
      sides_{},
      top_(std::min(a.center.y - a.radius, b.center.y - b.radius)),
      bottom_(std::max(a.center.y + a.radius, b.center.y + b.radius)) {
    const double dx = b.center.x - a.center.x;
    const double dy = b.center.y - a.center.y;
    const double length = std::hypot(dx, dy);
    if (length <= std::abs(a.radius - b.radius)) return;

    // The normal of a common tangent makes the angle acos((ra - rb) / length) with the axis.
    const double along = (a.radius - b.radius) / length;
    const double across = std::sqrt(1.0 - along * along);
    for (const double sign : {-1.0, 1.0}) {
        const Vec2 normal{(along * dx - sign * across * dy) / length,
                          (along * dy + sign * across * dx) / length};
        sides_[std::size_t(side_count_++)] = {
            {a.center.x + a.radius * normal.x, a.center.y + a.radius * normal.y},
            {b.center.x + b.radius * normal.x, b.center.y + b.radius * normal.y}};
    }
}

Span DiscHull::at(double y) const {
    Span span{std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()};
    const auto include = [&span](double x) {
        span.begin = std::min(span.begin, x);
        span.end = std::max(span.end, x);
    };
    for (const Disc& disc : discs_) {
        const double dy = y - disc.center.y;
        const double square = disc.radius * disc.radius - dy * dy;
        if (square < 0) continue;
        const double half = std::sqrt(square);
        include(disc.center.x - half);
        include(disc.center.x + half);
    }
    for (int i = 0; i < side_count_; ++i) {
        const auto& [from, to] = sides_[std::size_t(i)];
        if ((from.y < y) == (to.y < y)) continue;  // a level side ends in both discs
        include(from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x));
    }
    return span;
}

std::vector<Span> united(std::vector<Span>& spans) {
    std::ranges::sort(spans, {}, &Span::begin);
    std::vector<Span> disjoint;
    for (const Span& span : spans) {
        if (!disjoint.empty() && span.begin <= disjoint.back().end) {
            disjoint.back().end = std::max(disjoint.back().end, span.end);
        } else {
            disjoint.push_back(span);
        }
    }
    return disjoint;
}

std::vector<Span> spans_of(std::vector<Crossing>& crossings) {
    std::ranges::sort(crossings, {}, &Crossing::x);
    std::vector<Span> spans;
    int winding = 0;
    double begin = 0;
    for (const Crossing& crossing : crossings) {
        if (winding == 0) begin = crossing.x;
        winding += crossing.direction;
        if (winding == 0) spans.push_back({begin, crossing.x});
    }
    return spans;
}

}  // namespace haarmony::image
