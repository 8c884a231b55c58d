#include "engine/curve/wavelet_peak.h"

#include <gtest/gtest.h>

#include "engine/curve/multires_curve.h"
#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr double kSearched =
    1e-6;  // the top is flat: a search finds it to half the digits

TEST(WaveletPeak, OfAnOpenCurveIsWhereASearchFindsIt) {
    for (int level = 1; level <= 4; ++level) {
        for (std::size_t row = 0; row < segment_count(level); ++row) {
            const Points wavelet = dense::wavelet(level, row);
            EXPECT_NEAR(wavelet_peak(level, Ends::kOpen, row),
                        dense::peak(wavelet, Ends::kOpen),
                        kSearched)
                << "level " << level << " row " << row;
        }
    }
}

TEST(WaveletPeak, OfAClosedCurveIsWhereASearchFindsIt) {
    // Level 0 is as large at 0 as at 1/2, and positive at 1/2 alone.
    EXPECT_EQ(wavelet_peak(0, Ends::kClosed, 0), 0.5);
    for (int level = 1; level <= 4; ++level) {
        const Points zero(control_count(level, Ends::kClosed), 1);
        for (std::size_t row = 0; row < segment_count(level); ++row) {
            Points detail(segment_count(level), 1);
            detail[row][0] = 1;
            const Points wavelet = synthesize(zero, detail, Ends::kClosed);
            EXPECT_NEAR(wavelet_peak(level, Ends::kClosed, row),
                        dense::peak(wavelet, Ends::kClosed),
                        kSearched)
                << "level " << level << " row " << row;
        }
    }
}

TEST(WaveletPeak, OfTwoEqualEndsIsTheMiddle) {
    const Points wavelet = dense::wavelet(0, 0);
    EXPECT_NEAR(wavelet[0][0], wavelet[4][0], 1e-9);
    EXPECT_EQ(wavelet_peak(0, Ends::kOpen, 0), 0.5);
}

TEST(WaveletPeak, IsTheSameFromBehind) {
    for (int level = 0; level <= 6; ++level) {
        const std::size_t rows = segment_count(level);
        for (std::size_t row = 0; row < rows; ++row) {
            EXPECT_NEAR(wavelet_peak(level, Ends::kOpen, row),
                        1 - wavelet_peak(level, Ends::kOpen, rows - 1 - row),
                        1e-15)
                << "level " << level << " row " << row;
        }
    }
}

TEST(WaveletPeak, ScalesWithTheLevelOnceNoWaveletFeelsBothEnds) {
    for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_DOUBLE_EQ(wavelet_peak(12, Ends::kOpen, row) * 512,
                         wavelet_peak(3, Ends::kOpen, row))
            << row;
    }
}

}  // namespace
}  // namespace haarmony::curve
