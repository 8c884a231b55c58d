#include "engine/curve/chain.h"

#include <gtest/gtest.h>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

TEST(Chain, SamplesLieOnThePieces) {
    const Points bezier = bezier_points(drawn_stroke({.level = 4}), Ends::kOpen);
    const Chain chain = make_chain(bezier);
    ASSERT_EQ(chain.pieces.size(), 16U);
    ASSERT_EQ(chain.samples.size(), 16 * kSamplesPerPiece + 1);
    for (std::size_t i = 0; i < 16 * kSamplesPerPiece; ++i) {
        const std::vector<double> want =
            bernstein_sum(bezier,
                          i / kSamplesPerPiece * 3,
                          double(i % kSamplesPerPiece) / kSamplesPerPiece);
        EXPECT_NEAR(norm(chain.samples[i] - in_plane(want)), 0, 1e-11) << i;
    }
    EXPECT_EQ(chain.samples.back(), in_plane(bezier[bezier.size() - 1]));
}

TEST(Chain, LengthsAddUpTheDistancesOfSamples) {
    const Chain chain =
        make_chain(bezier_points(drawn_stroke({.level = 3}), Ends::kOpen));
    double sum = 0;
    for (std::size_t i = 5; i < 20; ++i)
        sum += norm(chain.samples[i + 1] - chain.samples[i]);
    EXPECT_NEAR(chain.length(5, 20), sum, 1e-10);
}

TEST(Chain, TangentsOfASmoothCurveAreTheSameOnBothSides) {
    const Chain chain =
        make_chain(bezier_points(drawn_stroke({.level = 5}), Ends::kOpen));
    for (std::size_t k = 1; k < chain.pieces.size(); ++k) {
        EXPECT_NEAR(norm(chain.arriving[k - 1] - chain.leaving[k]), 0, 1e-9) << k;
    }
}

TEST(Chain, ItsSizeIsTheLargestCoordinate) {
    Points line(4, 2);
    line[3][0] = 2;
    line[3][1] = -70;
    EXPECT_EQ(make_chain(line).size, 70);
}

}  // namespace
}  // namespace haarmony::curve
