#include "engine/curve/carried_fit.h"

#include <gtest/gtest.h>

#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

constexpr std::size_t kPieces = 4;
const Cuts kCuts = {0, 0.2, 0.55, 0.8, 1};

// Pieces of the cubic with control values `v` between kCuts, by blossoms.
Points cut_pieces(const double (&v)[4]) {
    const auto blossom = [&v](double a, double b, double c) {
        const auto mix = [](double p, double q, double t) { return p + t * (q - p); };
        const double first[] = {
            mix(v[0], v[1], a), mix(v[1], v[2], a), mix(v[2], v[3], a)};
        const double second[] = {mix(first[0], first[1], b), mix(first[1], first[2], b)};
        return mix(second[0], second[1], c);
    };
    Points chain(3 * kPieces + 1, 3);
    for (std::size_t k = 0; k < kPieces; ++k) {
        const double s = kCuts[k];
        const double e = kCuts[k + 1];
        chain[3 * k][2] = blossom(s, s, s);
        chain[3 * k + 1][2] = blossom(s, s, e);
        chain[3 * k + 2][2] = blossom(s, e, e);
        chain[3 * k + 3][2] = blossom(e, e, e);
    }
    return chain;
}

TEST(CarriedFit, FindsWhatWasCut) {
    const double values[4] = {2, -3, 7, 1};
    const Points chain = cut_pieces(values);
    Points bezier(8, 3);
    fit_carried(chain, 0, kPieces, kCuts, bezier, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(bezier[4 + i][2], values[i], 1e-10) << i;
        EXPECT_EQ(bezier[i][2], 0);
    }
}

TEST(CarriedFit, LeavesXAndYAlone) {
    Points bezier(4, 3);
    bezier[1][0] = 5;
    bezier[2][1] = 6;
    fit_carried(cut_pieces({1, 1, 1, 1}), 0, kPieces, kCuts, bezier, 0);
    EXPECT_EQ(bezier[1][0], 5);
    EXPECT_EQ(bezier[2][1], 6);
}

TEST(CarriedFit, IsALineWhereAllCutsFallTogether) {
    Points chain = cut_pieces({0, 5, 5, 9});
    Points bezier(4, 3);
    fit_carried(chain, 0, kPieces, {0, 0, 0, 0, 0}, bezier, 0);
    EXPECT_EQ(bezier[1][2], 3);
    EXPECT_EQ(bezier[2][2], 6);
}

}  // namespace
}  // namespace haarmony::curve
