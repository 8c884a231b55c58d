#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/video/display.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::linked_clip;
using testing::moving_clip;
using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;

constexpr std::array kBothEdges = {Edge::kPad, Edge::kNormalize};

PixelBox whole(const ClipShape& shape, std::int32_t root_side) {
    return {0, 0, zoomed_width(shape, root_side), zoomed_height(shape, root_side)};
}

// A pixel of the root square at a level; outside the picture clear, or the edge goes on.
Rgba padded(const Picture& picture, std::int32_t x, std::int32_t y, Edge edge) {
    if (edge == Edge::kNormalize) {
        return picture.at(std::min(x, picture.width - 1),
                          std::min(y, picture.height - 1));
    }
    return x < picture.width && y < picture.height ? picture.at(x, y) : kClear;
}

// As the dissertation writes it: every pixel of level l is put where it belongs, the last one
// stays; the colours are then mixed with those of level l - 1.
Picture scattered(const Frame& frame, std::int32_t m, Edge edge) {
    const ClipShape& shape = frame.shape();
    const int l = static_cast<int>(std::ceil(std::log2(m)));
    std::vector<std::int32_t> source(static_cast<std::size_t>(m));
    for (std::int32_t x = 0; x < 1 << l; ++x) {
        source[static_cast<std::size_t>(std::int64_t{x} * m >> l)] = x;
    }
    const Picture fine = draw(frame, l, edge);
    const Picture coarse = draw(frame, std::max(l - 1, 0), edge);
    Picture result(zoomed_width(shape, m), zoomed_height(shape, m));
    for (std::int32_t y = 0; y < result.height; ++y) {
        for (std::int32_t x = 0; x < result.width; ++x) {
            const std::int32_t u = source[static_cast<std::size_t>(x)];
            const std::int32_t v = source[static_cast<std::size_t>(y)];
            const Rgba p = padded(fine, u, v, edge);
            if (m == 1 << l) {
                result.at(x, y) = p;
                continue;
            }
            const Rgba q = padded(coarse, u >> 1, v >> 1, edge);
            const auto h = std::uint64_t{1} << (l - 1);
            PixelSum sum = sum_of(p, static_cast<std::uint64_t>(m) - h);
            sum += sum_of(q, 2 * h - static_cast<std::uint64_t>(m));
            result.at(x, y) = mean(sum, h);
        }
    }
    return result;
}

TEST(Zoom, EverySizeIsTheScatterOfTheDissertation) {
    for (const auto& [width, height] : {std::array{32, 32}, {21, 30}, {1, 17}, {3, 2}}) {
        const RawClip raw = random_clip(width, height, 2, 1);
        const auto clip = plain_clip(raw);
        const int finest = clip->shape().space_levels();
        const Frame frame = *clip->frame({0, 0}, finest);
        for (std::int32_t m = 1; m <= 1 << finest; ++m) {
            for (const Edge edge : kBothEdges) {
                EXPECT_EQ(zoom(frame, m, edge, whole(clip->shape(), m)),
                          scattered(frame, m, edge))
                    << width << "x" << height << " at " << m << " edge " << int(edge);
            }
        }
    }
}

TEST(Zoom, APowerOfTwoIsThatLevel) {
    const RawClip raw = moving_clip(45, 30, 1, 2);
    const auto clip = linked_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 6);
    for (int level = 0; level <= 6; ++level) {
        EXPECT_EQ(zoom_level(clip->shape(), 1 << level), level);
        for (const Edge edge : kBothEdges) {
            for (const Finer finer : {Finer::kFlat, Finer::kSmooth}) {
                EXPECT_EQ(
                    zoom(
                        frame, 1 << level, edge, whole(clip->shape(), 1 << level), finer),
                    draw(frame, level, edge));
            }
        }
    }
}

TEST(Zoom, ABoxIsThatPartOfThePicture) {
    std::mt19937 random(3);
    const auto clip = linked_clip(moving_clip(45, 30, 1, 4));
    const Frame frame = *clip->frame({0, 0}, 6);
    for (int round = 0; round < 200; ++round) {
        const auto m = static_cast<std::int32_t>(1 + random() % 200);
        const Edge edge = kBothEdges[random() % 2];
        const Finer finer = random() % 2 == 0 ? Finer::kFlat : Finer::kSmooth;
        const Picture all = zoom(frame, m, edge, whole(clip->shape(), m), finer);
        const auto below = [&random](std::int32_t n) {
            return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
        };
        const std::int32_t x = below(all.width), y = below(all.height);
        const PixelBox box{x, y, below(all.width - x + 1), below(all.height - y + 1)};
        const Picture part = zoom(frame, m, edge, box, finer);
        ASSERT_EQ(part.width, box.width);
        for (std::int32_t v = 0; v < part.height; ++v) {
            for (std::int32_t u = 0; u < part.width; ++u) {
                ASSERT_EQ(part.at(u, v), all.at(x + u, y + v))
                    << m << ": " << u << "," << v;
            }
        }
    }
}

TEST(Zoom, AnOpaqueClipIsOpaqueUpToItsEdges) {
    RawClip raw{{37, 23, {25, 1}}, {random_clip(37, 23, 1, 5).frames[0]}};
    for (Rgba& pixel : raw.frames[0].pixels) pixel.a = 255;
    const auto clip = plain_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 6);
    for (std::int32_t m = 1; m <= 150; ++m) {
        for (const Finer finer : {Finer::kFlat, Finer::kSmooth}) {
            const Picture picture =
                zoom(frame, m, Edge::kNormalize, whole(clip->shape(), m), finer);
            for (const Rgba& pixel : picture.pixels) ASSERT_EQ(pixel.a, 255) << m;
        }
    }
}

TEST(Zoom, WholeMultiplesRepeatEachPixel) {
    const auto clip = plain_clip(random_clip(6, 5, 1, 6));
    const Frame frame = *clip->frame({0, 0}, 3);
    const Picture finest = draw(frame, 3, Edge::kPad);
    const Picture large = zoom(frame, 8 * 7, Edge::kPad, whole(clip->shape(), 8 * 7));
    ASSERT_EQ(large.width, 6 * 7);
    ASSERT_EQ(large.height, 5 * 7);
    for (std::int32_t y = 0; y < large.height; ++y) {
        for (std::int32_t x = 0; x < large.width; ++x) {
            ASSERT_EQ(large.at(x, y), finest.at(x / 7, y / 7)) << x << "," << y;
        }
    }
}

// Bilinear interpolation between centres, in floating point.
TEST(Zoom, SmoothEnlargingIsBilinearBetweenCentres) {
    const auto clip = plain_clip(random_clip(6, 5, 1, 7));
    const Frame frame = *clip->frame({0, 0}, 3);
    const Picture finest = draw(frame, 3, Edge::kPad);
    for (const std::int32_t m : {9, 13, 40, 101}) {
        const Picture large =
            zoom(frame, m, Edge::kPad, whole(clip->shape(), m), Finer::kSmooth);
        for (std::int32_t y = 0; y < large.height; ++y) {
            for (std::int32_t x = 0; x < large.width; ++x) {
                const double u = (x + 0.5) * 8 / m - 0.5, v = (y + 0.5) * 8 / m - 0.5;
                double sum_a = 0, sum_g = 0;
                for (const int j : {0, 1}) {
                    for (const int i : {0, 1}) {
                        const double w = std::abs(1 - i - (u - std::floor(u))) *
                                         std::abs(1 - j - (v - std::floor(v)));
                        const Rgba p = finest.at(
                            std::clamp(static_cast<int>(std::floor(u)) + i, 0, 5),
                            std::clamp(static_cast<int>(std::floor(v)) + j, 0, 4));
                        sum_a += w * p.a;
                        sum_g += w * p.a * p.g;
                    }
                }
                const Rgba got = large.at(x, y);
                ASSERT_NEAR(got.a, sum_a, 0.51) << m << ": " << x << "," << y;
                // Weights have 16 bits: where little alpha is left a colour shows that.
                if (sum_a > 4) {
                    ASSERT_NEAR(got.g, sum_g / sum_a, 0.6) << m << ": " << x << "," << y;
                }
            }
        }
    }
}

TEST(Zoom, ASmoothEdgeRisesFromOnePixelToTheNext) {
    RawClip raw{{8, 8, {25, 1}}, {Picture(8, 8)}};
    for (int i = 0; i < 64; ++i) {
        const auto grey = static_cast<std::uint8_t>(i % 8 < 4 ? 0 : 200);
        raw.frames[0].pixels[static_cast<std::size_t>(i)] = {grey, grey, grey, 255};
    }
    const auto clip = plain_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 3);
    const Picture row = zoom(frame, 80, Edge::kPad, {0, 40, 80, 1}, Finer::kSmooth);
    int between = 0;
    for (std::int32_t x = 1; x < 80; ++x) {
        ASSERT_GE(row.at(x, 0).r, row.at(x - 1, 0).r);
        between += row.at(x, 0).r > 0 && row.at(x, 0).r < 200 ? 1 : 0;
    }
    EXPECT_EQ(between, 10);  // from centre to centre
}

TEST(Zoom, EnlargedSixteenTimesNothingOverflows) {
    const auto clip = plain_clip(random_clip(3, 3, 1, 8));
    const Frame frame = *clip->frame({0, 0}, 2);
    const Picture finest = draw(frame, 2, Edge::kPad);
    const std::int32_t right = zoomed_width(clip->shape(), kMaxRootSide);
    ASSERT_EQ(right, kMaxRootSide / 4 * 3);
    for (const Finer finer : {Finer::kFlat, Finer::kSmooth}) {
        const Picture corner =
            zoom(frame, kMaxRootSide, Edge::kPad, {right - 1, right - 1, 1, 1}, finer);
        EXPECT_EQ(corner.at(0, 0), finest.at(2, 2));
    }
}

TEST(ZoomedSize, AtALevelIsThatLevels) {
    for (const auto& [width, height] : {std::array{100, 60}, {5, 70}, {1, 1}, {37, 23}}) {
        const ClipShape shape = *ClipShape::make({width, height, {25, 1}}, 1);
        for (int level = 0; level <= shape.space_levels(); ++level) {
            EXPECT_EQ(zoomed_width(shape, 1 << level), shape.width_at(level));
            EXPECT_EQ(zoomed_height(shape, 1 << level), shape.height_at(level));
        }
    }
}

TEST(RootSideForWidth, MakesTheClipThatWide) {
    for (const auto& [width, height] :
         {std::array{100, 60}, {5, 70}, {768, 432}, {1, 3}}) {
        const ClipShape shape = *ClipShape::make({width, height, {25, 1}}, 1);
        for (std::int64_t want = 1; want < 2000; want = want * 3 / 2 + 1) {
            const Result<std::int32_t> side = root_side_for_width(shape, want);
            ASSERT_TRUE(side.has_value());
            const double exact =
                std::ldexp(static_cast<double>(want), shape.space_levels()) / width;
            EXPECT_LE(std::abs(*side - exact), 0.5);
            const std::int32_t wide = zoomed_width(shape, *side);
            EXPECT_TRUE(wide == want || wide == want + 1) << want << " is " << wide;
        }
        EXPECT_EQ(*root_side_for_width(shape, width), 1 << shape.space_levels());
    }
}

TEST(RootSideForWidth, RefusesWhatNoRootSquareHas) {
    const ClipShape shape = *ClipShape::make({100, 60, {25, 1}}, 1);
    const std::int64_t most = std::int64_t{kMaxRootSide} * 100 / 128;
    EXPECT_TRUE(root_side_for_width(shape, most).has_value());
    for (const std::int64_t bad : {std::int64_t{0}, std::int64_t{-3}, most + 1}) {
        const Result<std::int32_t> side = root_side_for_width(shape, bad);
        ASSERT_FALSE(side.has_value()) << bad;
        EXPECT_EQ(side.error().param, "width");
        EXPECT_NE(side.error().message.find(std::to_string(bad)), std::string::npos);
    }
}

}  // namespace
}  // namespace haarmony::video
