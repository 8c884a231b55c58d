#include "engine/image/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace haarmony::image {
namespace {

StrokePicture canvas(int width, int height) { return {width, height, std::nullopt, {}}; }

std::array<int, 4> pixel(const Raster& raster, int x, int y) {
    std::array<int, 4> result{};
    for (int c = 0; c < 4; ++c) {
        result[c] = raster.rgba[(std::size_t(y) * raster.width + x) * 4 + c];
    }
    return result;
}

// The share of a pixel that is inside: kSubRows lines, and many samples along each.
template <typename Inside>
double share_inside(int x, int y, const Inside& inside) {
    constexpr int kSamples = 64;
    int hits = 0;
    for (int line = 0; line < kSubRows; ++line) {
        for (int s = 0; s < kSamples; ++s) {
            hits += inside(x + (s + 0.5) / kSamples, y + (line + 0.5) / kSubRows) ? 1 : 0;
        }
    }
    return double(hits) / (kSubRows * kSamples);
}

// One sample of 64 on each end of a span, and the rounding of alpha.
constexpr double kShareTolerance = 2.0 / 64 + 0.5 / 255;

double distance_to_segment(const Point& a, const Point& b, double x, double y) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    const double t =
        square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0)
                   : 0.0;
    return std::hypot(a.x + t * dx - x, a.y + t * dy - y);
}

// The angle that the closed polygon turns by, seen from the point, in whole turns.
int winding_number(const std::vector<Point>& points, double x, double y) {
    double angle = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& a = points[i];
        const Point& b = points[(i + 1) % points.size()];
        angle +=
            std::remainder(std::atan2(b.y - y, b.x - x) - std::atan2(a.y - y, a.x - x),
                           2 * std::numbers::pi);
    }
    return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

std::vector<Point> random_points(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
        const float x = static_cast<float>(random() % 4800) / 100.0F - 8;
        const float y = static_cast<float>(random() % 4000) / 100.0F - 8;
        points.push_back({x, y});
    }
    return points;
}

TEST(Strokes, CoverWhatLiesWithinHalfAWidthOfTheLine) {
    const std::vector<Point> points = random_points(6, 191);
    for (const float width : {0.7F, 3.0F, 9.0F}) {
        StrokePicture picture = canvas(32, 24);
        picture.items.push_back({points, {width}, Rgb{255, 0, 0}, false});
        const Raster raster = rasterize(picture);
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 32; ++x) {
                const double expected = share_inside(x, y, [&](double px, double py) {
                    for (std::size_t i = 1; i < points.size(); ++i) {
                        if (distance_to_segment(points[i - 1], points[i], px, py) <=
                            width / 2) {
                            return true;
                        }
                    }
                    return false;
                });
                ASSERT_NEAR(pixel(raster, x, y)[3] / 255.0, expected, kShareTolerance * 2)
                    << "width " << width << " at " << x << ", " << y;
            }
        }
    }
}

TEST(Strokes, ChangeTheirWidthFromPointToPoint) {
    StrokePicture picture = canvas(40, 20);
    picture.items.push_back({{{5, 10}, {35, 10}}, {2, 12}, Rgb{0, 0, 255}, false});
    const Raster raster = rasterize(picture);
    const auto column_alpha = [&](int x) {
        int sum = 0;
        for (int y = 0; y < 20; ++y) sum += pixel(raster, x, y)[3];
        return sum / 255.0;
    };
    // The height of the hull of two discs at x: the tangents' slope is sin = 5 / 30.
    const double slope = (5.0 / 30) / std::sqrt(1 - (5.0 / 30) * (5.0 / 30));
    const double at_center = 1 / std::sqrt(1 - (5.0 / 30) * (5.0 / 30));
    for (const int x : {8, 15, 25, 33}) {
        EXPECT_NEAR(column_alpha(x), 2 * (at_center + slope * (x + 0.5 - 5)), 0.3) << x;
    }
}

TEST(Strokes, OfOnePointAreDots) {
    StrokePicture picture = canvas(21, 21);
    picture.items.push_back({{{10.5F, 10.5F}}, {16}, Rgb{9, 8, 7}, false});
    const Raster raster = rasterize(picture);
    double area = 0;
    for (int y = 0; y < 21; ++y) {
        for (int x = 0; x < 21; ++x) area += pixel(raster, x, y)[3] / 255.0;
    }
    EXPECT_NEAR(area, std::numbers::pi * 64, 1.0);
    EXPECT_EQ(pixel(raster, 10, 10), (std::array<int, 4>{9, 8, 7, 255}));
    EXPECT_EQ(pixel(raster, 0, 0), (std::array<int, 4>{0, 0, 0, 0}));
}

TEST(Strokes, WithFillCoverThePolygonByTheNonZeroRule) {
    for (const unsigned seed : {192U, 193U, 194U}) {
        const std::vector<Point> points = random_points(7, seed);
        StrokePicture picture = canvas(32, 24);
        picture.items.push_back({points, {}, Rgb{1, 2, 3}, true});
        const Raster raster = rasterize(picture);
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 32; ++x) {
                const double expected = share_inside(x, y, [&](double px, double py) {
                    return winding_number(points, px, py) != 0;
                });
                ASSERT_NEAR(pixel(raster, x, y)[3] / 255.0, expected, kShareTolerance * 2)
                    << "seed " << seed << " at " << x << ", " << y;
            }
        }
    }
}

TEST(Strokes, APolygonWoundTwiceHasNoHole) {
    StrokePicture picture = canvas(10, 10);
    const std::vector<Point> square = {{2, 2}, {8, 2}, {8, 8}, {2, 8}};
    std::vector<Point> twice = square;
    twice.insert(twice.end(), square.begin(), square.end());
    picture.items.push_back({twice, {}, Rgb{1, 1, 1}, true});
    const Raster raster = rasterize(picture);
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 10; ++x) {
            const bool inside = x >= 2 && x < 8 && y >= 2 && y < 8;
            EXPECT_EQ(pixel(raster, x, y)[3], inside ? 255 : 0) << x << ", " << y;
        }
    }
}

TEST(Strokes, LaterOnesCoverEarlierOnesAndTheBackground) {
    StrokePicture picture{8, 8, Rgb{10, 20, 30}, {}};
    picture.items.push_back({{{0, 4}, {8, 4}}, {8}, Rgb{200, 0, 0}, false});
    picture.items.push_back({{{0, 2}, {8, 2}}, {2}, Rgb{0, 200, 0}, false});
    const Raster raster = rasterize(picture);
    EXPECT_EQ(pixel(raster, 4, 1), (std::array<int, 4>{0, 200, 0, 255}));
    EXPECT_EQ(pixel(raster, 4, 5), (std::array<int, 4>{200, 0, 0, 255}));
    picture.items.clear();
    EXPECT_EQ(pixel(rasterize(picture), 4, 4), (std::array<int, 4>{10, 20, 30, 255}));
}

TEST(Strokes, OfNoPointsNoWidthOrNoAreaPaintNothing) {
    StrokePicture picture = canvas(6, 6);
    picture.items.push_back({{}, {}, Rgb{255, 255, 255}, false});
    picture.items.push_back({{{1, 1}, {5, 4}}, {0}, Rgb{255, 255, 255}, false});
    picture.items.push_back({{{1, 1}, {5, 4}}, {}, Rgb{255, 255, 255}, true});
    picture.items.push_back({{{3, 3}}, {}, Rgb{255, 255, 255}, true});
    EXPECT_EQ(rasterize(picture).rgba, std::vector<std::uint8_t>(6 * 6 * 4, 0));
}

// The canvas is a window: what is painted in it does not depend on what lies outside.
TEST(Strokes, PointsFarOutsideAreClipped) {
    StrokePicture picture = canvas(16, 16);
    constexpr float kFar = std::numeric_limits<float>::max();
    picture.items.push_back({{{-1e6F, 8}, {1e6F, 8}}, {4}, Rgb{50, 60, 70}, false});
    picture.items.push_back({{{kFar, kFar}, {-kFar, kFar}}, {9}, Rgb{1, 1, 1}, false});
    picture.items.push_back(
        {{{0, kFar}, {kFar, kFar}, {kFar, 99}}, {}, Rgb{1, 1, 1}, true});
    const Raster raster = rasterize(picture);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const bool inside = y >= 6 && y < 10;
            EXPECT_EQ(pixel(raster, x, y),
                      inside ? (std::array<int, 4>{50, 60, 70, 255})
                             : (std::array<int, 4>{0, 0, 0, 0}))
                << x << ", " << y;
        }
    }
}

TEST(Strokes, ALargeCanvasIsPaintedSmallerInProportion) {
    StrokePicture picture = canvas(4 * kMaxRasterSide, kMaxRasterSide);
    const float side = kMaxRasterSide;
    picture.items.push_back(
        {{{0, 0}, {2 * side, 0}, {2 * side, side}, {0, side}}, {}, Rgb{5, 6, 7}, true});
    const Raster raster = rasterize(picture);
    ASSERT_EQ(raster.width, kMaxRasterSide);
    ASSERT_EQ(raster.height, kMaxRasterSide / 4);
    EXPECT_EQ(raster.view().row_stride, 4 * kMaxRasterSide);
    EXPECT_EQ(pixel(raster, kMaxRasterSide / 2 - 1, 60),
              (std::array<int, 4>{5, 6, 7, 255}));
    EXPECT_EQ(pixel(raster, kMaxRasterSide / 2, 60), (std::array<int, 4>{0, 0, 0, 0}));
    EXPECT_EQ(rasterize(canvas(kMaxCanvasSide, 1)).height, 1);
}

TEST(CheckStrokes, RefusesByName) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto with = [](const Stroke& stroke) {
        StrokePicture picture{10, 10, std::nullopt, {}};
        picture.items = {Stroke{}, stroke};
        return picture;
    };
    StrokePicture many_strokes{10, 10, std::nullopt, {}};
    many_strokes.items.resize(kMaxStrokes + 1);
    const Stroke long_stroke{
        std::vector<Point>(kMaxStrokePoints / 2 + 1), {1}, {}, false};
    StrokePicture many_points = with(long_stroke);
    many_points.items.push_back(long_stroke);

    const std::pair<StrokePicture, std::string_view> cases[] = {
        {canvas(0, 10), "width 0 is outside 1..65535"},
        {canvas(10, 65536), "height 65536 is outside 1..65535"},
        {canvas(-3, 10), "width -3"},
        {with({{{kNan, 0}}, {1}, {}, false}), "coordinate nan in stroke 1"},
        {with({{{0, kInfinity}}, {}, {}, true}), "coordinate inf in stroke 1"},
        {with({{{0, 0}}, {-1}, {}, false}), "width -1.000000 in stroke 1"},
        {with({{{0, 0}}, {kNan}, {}, false}), "width nan in stroke 1"},
        {with({{{0, 0}}, {kInfinity}, {}, false}), "width inf in stroke 1"},
        {with({{{0, 0}}, {}, {}, false}), "0 widths for 1 points in stroke 1"},
        {with({{{0, 0}, {1, 1}, {2, 2}}, {1, 1}, {}, false}), "2 widths for 3 points"},
        {many_strokes, "2001 strokes, at most 2000"},
        {many_points, "20002 points, at most 20000"},
    };
    for (const auto& [picture, reason] : cases) {
        const Result<void> checked = check_strokes(picture);
        ASSERT_FALSE(checked) << reason;
        EXPECT_EQ(checked.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(checked.error().param, "strokes");
        EXPECT_NE(checked.error().message.find(reason), std::string::npos)
            << checked.error().message;
    }
}

TEST(CheckStrokes, AcceptsTheLargest) {
    StrokePicture picture = canvas(kMaxCanvasSide, kMaxCanvasSide);
    picture.items.assign(kMaxStrokes, {std::vector<Point>(10), {3}, {}, false});
    EXPECT_TRUE(check_strokes(picture));
}

}  // namespace
}  // namespace haarmony::image
