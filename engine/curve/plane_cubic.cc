#include "engine/curve/plane_cubic.h"

#include <cassert>
#include <limits>

namespace haarmony::curve {
namespace {

// Control points that coincide do so up to rounding when they are computed from others, and
// the direction between them is then noise.
double negligible(const PlaneCubic& p) {
    double size = 0;
    for (const PlaneVector v : p) size = std::max({size, std::abs(v.x), std::abs(v.y)});
    return 64 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

std::vector<PlaneCubic> cubics_of(const Points& bezier) {
    assert(bezier.size() % 4 == 0);
    std::vector<PlaneCubic> cubics(bezier.size() / 4);
    for (std::size_t i = 0; i < cubics.size(); ++i) cubics[i] = cubic_at(bezier, 4 * i);
    return cubics;
}

std::pair<PlaneCubic, PlaneCubic> split(const PlaneCubic& p, double t) {
    const PlaneVector a = between(p[0], p[1], t);
    const PlaneVector b = between(p[1], p[2], t);
    const PlaneVector c = between(p[2], p[3], t);
    const PlaneVector ab = between(a, b, t);
    const PlaneVector bc = between(b, c, t);
    const PlaneVector middle = between(ab, bc, t);
    return {{p[0], a, ab, middle}, {middle, bc, c, p[3]}};
}

PlaneVector tangent_at_start(const PlaneCubic& p) {
    const double least = negligible(p);
    for (std::size_t i = 1; i < 4; ++i) {
        if (norm(p[i] - p[0]) > least) return unit(p[i] - p[0]);
    }
    return {};
}

PlaneVector tangent_at_end(const PlaneCubic& p) {
    const double least = negligible(p);
    for (std::size_t i = 3; i-- > 0;) {
        if (norm(p[3] - p[i]) > least) return unit(p[3] - p[i]);
    }
    return {};
}

}  // namespace haarmony::curve
