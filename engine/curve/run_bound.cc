#include "engine/curve/run_bound.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace haarmony::curve {
namespace {

// A part that is not within the tolerance after six halvings would hardly be after more:
// what the difference has beyond the distance itself is then divided by 4096.
constexpr int kMostHalvings = 6;
constexpr int kNewtonSteps = 3;

// A parameter of the cubic, the point and the derivative there.
struct Cut {
    double t;
    PlaneVector point;
    PlaneVector slope;
};
Cut cut_at(const PlanePolynomial& cubic, double t) {
    return {t, cubic.value(t), cubic.slope(t)};
}

class Proof {
  public:
    Proof(const PlanePolynomial& cubic, double tolerance)
        : cubic_(cubic), tolerance2_(tolerance * tolerance) {}

    bool within(PlaneVector difference) const {
        return squared(difference) <= tolerance2_;
    }

    // Whether the part between two cuts is close to `piece`.
    bool holds(const PlaneCubic& piece, const Cut& from, const Cut& to, int halvings) {
        const double third = (to.t - from.t) / 3;
        const double longest2 =
            std::max({squared(piece[0] - from.point),
                      squared(piece[1] - (from.point + third * from.slope)),
                      squared(piece[2] - (to.point - third * to.slope)),
                      squared(piece[3] - to.point)});
        if (longest2 <= tolerance2_) {
            bound2_ = std::max(bound2_, longest2);
            return true;
        }
        if (halvings == kMostHalvings) return false;
        const auto [left, right] = split(piece, 0.5);
        const Cut middle = cut_at(
            cubic_,
            cubic_.nearest(left[3], (from.t + to.t) / 2, from.t, to.t, kNewtonSteps));
        return within(left[3] - middle.point) &&
               holds(left, from, middle, halvings + 1) &&
               holds(right, middle, to, halvings + 1);
    }

    double bound() const { return std::sqrt(bound2_); }

  private:
    const PlanePolynomial& cubic_;
    double tolerance2_;
    double bound2_ = 0;
};

// Cuts nearest to the joints; false if one of them is too far from the cubic.
bool cut_at_joints(const Chain& chain,
                   std::size_t first,
                   std::size_t last,
                   const PlanePolynomial& cubic,
                   const Proof& proof,
                   Cuts& cuts) {
    cuts.assign(1, 0);
    const std::size_t end = last * kSamplesPerPiece;
    for (std::size_t k = first + 1; k < last; ++k) {
        const std::size_t before = (k - 1) * kSamplesPerPiece;
        const double left = chain.length(before, end);
        const double share =
            left > 0 ? chain.length(before, before + kSamplesPerPiece) / left : 0;
        const double guess = cuts.back() + share * (1 - cuts.back());
        const PlaneVector joint = chain.pieces[k][0];
        const double t = cubic.nearest(joint, guess, cuts.back(), 1, kNewtonSteps);
        if (!proof.within(joint - cubic.value(t))) return false;
        cuts.push_back(t);
    }
    cuts.push_back(1);
    return true;
}

}  // namespace

std::optional<double> proved_bound(const Chain& chain,
                                   std::size_t first,
                                   std::size_t last,
                                   const PlaneCubic& cubic,
                                   double tolerance,
                                   Cuts& cuts) {
    assert(first < last && last <= chain.pieces.size());
    double size = chain.size;
    for (const PlaneVector p : cubic) {
        size = std::max({size, std::abs(p.x), std::abs(p.y)});
    }
    // A coefficient is a sum of less than 30 numbers of that size.
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * size;
    if (!(tolerance > rounding)) return std::nullopt;
    const PlanePolynomial polynomial(cubic);
    Proof proof(polynomial, tolerance - rounding);
    if (!cut_at_joints(chain, first, last, polynomial, proof, cuts)) return std::nullopt;
    Cut from = cut_at(polynomial, 0);
    for (std::size_t k = first; k < last; ++k) {
        const Cut to = cut_at(polynomial, cuts[k - first + 1]);
        if (!proof.holds(chain.pieces[k], from, to, 0)) return std::nullopt;
        from = to;
    }
    return std::min(proof.bound() + rounding, tolerance);
}

}  // namespace haarmony::curve
