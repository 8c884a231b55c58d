#include "engine/curve/nearest_cubic.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <utility>

namespace haarmony::curve {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Second differences of a part that is left whole, relative to its chord: its derivative
// then differs from the chord by less than half of it.
constexpr double kBent = 0.15;
// Where a cubic stands still or turns back, its parts shrink faster than they straighten:
// after so many halvings, or within rounding errors, they are points.
constexpr int kMostHalvings = 24;
constexpr int kNewtonSteps = 5;
constexpr int kWalkSteps = 3;
constexpr int kMostWalked = 4;  // parts; most samples are one or two further

double size_of(const PlaneCubic& p) {
    double size = 0;
    for (const PlaneVector v : p) size = std::max({size, std::abs(v.x), std::abs(v.y)});
    return size;
}

bool is_point(const PlaneCubic& p) {
    const double rounding = 32 * std::numeric_limits<double>::epsilon() * size_of(p);
    return std::max({norm(p[1] - p[0]), norm(p[2] - p[0]), norm(p[3] - p[0])}) <=
           rounding;
}

bool straight(const PlaneCubic& p) {
    const double limit2 = kBent * kBent * squared(p[3] - p[0]);
    return squared((p[2] - p[1]) - (p[1] - p[0])) <= limit2 &&
           squared((p[3] - p[2]) - (p[2] - p[1])) <= limit2;
}

}  // namespace

double NearestCubic::Box::distance2(PlaneVector q) const {
    const PlaneVector off{std::max({low.x - q.x, q.x - high.x, 0.0}),
                          std::max({low.y - q.y, q.y - high.y, 0.0})};
    return squared(off);
}

NearestCubic::NearestCubic(std::span<const PlaneCubic> cubics) {
    assert(!cubics.empty());
    for (const PlaneCubic& cubic : cubics) add(cubic, 0);
    leaves_ = std::bit_ceil(parts_.size());
    const std::vector<Box> of_parts = std::exchange(
        boxes_,
        std::vector<Box>(2 * leaves_,
                         Box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}}));
    std::ranges::copy(of_parts, boxes_.begin() + static_cast<std::ptrdiff_t>(leaves_));
    for (std::size_t i = leaves_; i-- > 1;) {
        const Box& a = boxes_[2 * i];
        const Box& b = boxes_[2 * i + 1];
        boxes_[i] = {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
                     {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
    }
}

void NearestCubic::add(const PlaneCubic& cubic, int halvings) {
    if (halvings < kMostHalvings && !straight(cubic) && !is_point(cubic)) {
        const auto [left, right] = split(cubic, 0.5);
        add(left, halvings + 1);
        add(right, halvings + 1);
        return;
    }
    parts_.emplace_back(cubic);
    Box& box = boxes_.emplace_back(Box{cubic[0], cubic[0]});
    for (const PlaneVector p : cubic) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
}

double NearestCubic::descend(std::size_t part,
                             PlaneVector q,
                             double t,
                             int steps,
                             CubicPlace& best) const {
    const PlanePolynomial& polynomial = parts_[part];
    t = polynomial.nearest(q, t, 0, 1, steps);
    const double distance2 = squared(polynomial.value(t) - q);
    if (distance2 < best.distance2) best = {part, t, distance2};
    return t;
}

void NearestCubic::search_part(std::size_t part, PlaneVector q, CubicPlace& best) const {
    descend(part, q, 0, 0, best);
    descend(part, q, 1, 0, best);
    const PlanePolynomial& polynomial = parts_[part];
    const PlaneVector chord = polynomial.c1 + polynomial.c2 + polynomial.c3;
    const double length2 = squared(chord);
    if (!(length2 > 0)) return;
    const double t = std::clamp(dot(q - polynomial.c0, chord) / length2, 0.0, 1.0);
    descend(part, q, t, kNewtonSteps, best);
}

void NearestCubic::search(std::size_t node, PlaneVector q, CubicPlace& best) const {
    if (!(boxes_[node].distance2(q) < best.distance2)) return;
    if (node >= leaves_) {
        search_part(node - leaves_, q, best);
        return;
    }
    const bool left = boxes_[2 * node].distance2(q) <= boxes_[2 * node + 1].distance2(q);
    search(2 * node + (left ? 0 : 1), q, best);
    search(2 * node + (left ? 1 : 0), q, best);
}

CubicPlace NearestCubic::find(PlaneVector q) const {
    CubicPlace best;
    search(1, q, best);
    return best;
}

CubicPlace NearestCubic::walk(PlaneVector q, CubicPlace near) const {
    CubicPlace best = near;
    best.distance2 = squared(parts_[near.part].value(near.t) - q);
    std::size_t part = near.part;
    double t = near.t;
    for (int walked = 0; walked < kMostWalked; ++walked) {
        t = descend(part, q, t, kWalkSteps, best);
        if (t >= 1 && part + 1 < parts_.size()) {
            ++part;
            t = 0;
        } else if (t <= 0 && part > 0) {
            --part;
            t = 1;
        } else {
            break;
        }
    }
    return best;
}

}  // namespace haarmony::curve
