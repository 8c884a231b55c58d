#include "engine/curve/frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr std::array kFrames = {Frame::kFixed, Frame::kNormalized, Frame::kUnnormalized};
constexpr std::array kEnds = {Ends::kOpen, Ends::kClosed};

// Turned by `angle` about the origin and scaled; other dimensions as they are.
Points turned(const Points& points, double angle, double scale) {
    Points result = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [x, y] = std::pair(points[i][0], points[i][1]);
        result[i][0] = scale * (std::cos(angle) * x - std::sin(angle) * y);
        result[i][1] = scale * (std::sin(angle) * x + std::cos(angle) * y);
    }
    return result;
}

TEST(Frame, FixedIsThePage) {
    const MultiresCurve curve =
        decompose(dense::random_curve(4, Ends::kOpen, 2, 1), Ends::kOpen);
    EXPECT_EQ(to_local(curve, Frame::kFixed).details, curve.details);
    EXPECT_EQ(to_world(to_local(curve, Frame::kFixed)).details, curve.details);
}

TEST(Frame, ThereAndBackIsTheCurveItself) {
    for (const Ends ends : kEnds) {
        for (const Frame frame : kFrames) {
            for (const int dimension : {1, 2, 4}) {
                for (int level = 0; level <= 6; ++level) {
                    const Points control = dense::random_curve(level, ends, dimension, 2);
                    const MultiresCurve curve = decompose(control, ends);
                    const LocalDetails local = to_local(curve, frame);
                    EXPECT_LT(dense::distance(reconstruct(local, level), control), 1e-9)
                        << int(ends) << int(frame) << " " << dimension << " " << level;
                    const MultiresCurve world = to_world(local);
                    for (int j = 0; j < level; ++j) {
                        EXPECT_LT(dense::distance(world.details[j], curve.details[j]),
                                  1e-9)
                            << int(ends) << int(frame) << " " << dimension << " " << j;
                    }
                }
            }
        }
    }
}

TEST(Frame, LocalDetailsAreAlongTheTangentOfTheCurveTheyRefine) {
    for (const Ends ends : kEnds) {
        const MultiresCurve curve = decompose(dense::random_curve(5, ends, 3, 3), ends);
        const LocalDetails normalized = to_local(curve, Frame::kNormalized);
        const LocalDetails unnormalized = to_local(curve, Frame::kUnnormalized);
        // A closed curve of level 0 is a point.
        for (int level = ends == Ends::kOpen ? 0 : 1; level < 5; ++level) {
            const Points control = dense::project(reconstruct(curve), ends, level);
            for (std::size_t row = 0; row < segment_count(level); ++row) {
                const double u = level == 0 || ends == Ends::kClosed
                                     ? (double(row) + 0.5) / std::ldexp(1, level)
                                     : dense::peak(dense::wavelet(level, row), ends);
                const std::vector<double> tangent = dense::slope(control, ends, u);
                const auto at_page = curve.details[level][row];
                const double length = std::hypot(tangent[0], tangent[1]);
                const double along =
                    (at_page[0] * tangent[0] + at_page[1] * tangent[1]) / length;
                const double across =
                    (at_page[1] * tangent[0] - at_page[0] * tangent[1]) / length;
                // The searched peak is good to 1e-7 or so, and so is the tangent.
                const double tolerance = 1e-4;
                const auto as_long = normalized.details[level][row];
                const auto grown = unnormalized.details[level][row];
                EXPECT_NEAR(as_long[0], along, tolerance) << level << " " << row;
                EXPECT_NEAR(as_long[1], across, tolerance) << level << " " << row;
                EXPECT_NEAR(grown[0] * length, along, tolerance) << level << " " << row;
                EXPECT_NEAR(grown[1] * length, across, tolerance) << level << " " << row;
                EXPECT_EQ(as_long[2], at_page[2]);
                EXPECT_EQ(grown[2], at_page[2]);
            }
        }
    }
}

TEST(Frame, TurningTheCoarseCurveTurnsTheWholeCurve) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(5, ends, 2, 4);
        for (const Frame frame : {Frame::kNormalized, Frame::kUnnormalized}) {
            // A closed curve of level 0 is a point and has no direction to turn.
            LocalDetails local = to_local(decompose(control, ends), frame);
            if (ends == Ends::kClosed)
                local.details[0] = turned(local.details[0], 1.1, 1);
            local.coarse = turned(local.coarse, 1.1, 1);
            EXPECT_LT(dense::distance(reconstruct(local, 5), turned(control, 1.1, 1)),
                      1e-9)
                << int(ends) << int(frame);
        }
    }
}

TEST(Frame, OnlyUnnormalizedDetailsGrowWithTheCurve) {
    const Points control = dense::random_curve(5, Ends::kOpen, 2, 5);
    const MultiresCurve small = decompose(control, Ends::kOpen);
    const MultiresCurve large = decompose(turned(control, 0, 3), Ends::kOpen);
    for (int level = 0; level < 5; ++level) {
        EXPECT_LT(dense::distance(to_local(small, Frame::kUnnormalized).details[level],
                                  to_local(large, Frame::kUnnormalized).details[level]),
                  1e-9);
        EXPECT_LT(dense::distance(
                      turned(to_local(small, Frame::kNormalized).details[level], 0, 3),
                      to_local(large, Frame::kNormalized).details[level]),
                  1e-9);
    }
}

TEST(Frame, WithoutATangentIsThatOfThePage) {
    Points detail(2, 2);
    detail[0][0] = 3;
    detail[1][1] = -4;
    const Points standing(control_count(1, Ends::kOpen), 2);
    for (const Frame frame : kFrames) {
        Points local = detail;
        into_frames(local, standing, Ends::kOpen, frame);
        EXPECT_EQ(local, detail) << int(frame);
        out_of_frames(local, standing, Ends::kOpen, frame);
        EXPECT_EQ(local, detail) << int(frame);
    }
}

}  // namespace
}  // namespace haarmony::curve
