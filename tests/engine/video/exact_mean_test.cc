#include "engine/video/exact_mean.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "engine/video/create_frame.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video::testing {
namespace {

constexpr Edge kEdgeRules[] = {Edge::kPad, Edge::kNormalize};

void expect_exact(const RawClip& clip, const ExactFrame& frame) {
    for (int level = 0; level <= shape_of(clip).space_levels(); ++level) {
        for (const Edge edge : kEdgeRules) {
            ASSERT_EQ(picture_of(frame, clip.format, level, edge),
                      exact_picture(clip, {0, 0}, level, edge))
                << clip.format.width << " x " << clip.format.height << " x "
                << clip.frames.size() << ", level " << level << ", edge " << int(edge);
        }
    }
}

TEST(ExactMean, IsTheDefinitionOfEveryShape) {
    constexpr int kSizes[][2] = {{1, 1},
                                 {1, 2},
                                 {3, 2},
                                 {4, 4},
                                 {5, 7},
                                 {8, 8},
                                 {9, 1},
                                 {13, 9},
                                 {16, 16},
                                 {5, 40},
                                 {33, 20},
                                 {32, 64}};
    std::uint32_t seed = 1;
    for (const auto& [width, height] : kSizes) {
        for (const int frames : {1, 3, 4, 7}) {
            const RawClip random = random_clip(width, height, frames, ++seed);
            expect_exact(random, mean_of(random));
            const RawClip still =
                opaque(random_clip(width, height, frames, ++seed, true));
            expect_exact(still, mean_of(still));
            const RawClip squares = blocks(width, height, frames, seed += 10);
            expect_exact(squares, mean_of(squares));
        }
    }
}

TEST(ExactMean, SumsAddUp) {
    const RawClip clip = blocks(50, 40, 7, 60);
    FrameSum all(clip.format), first(clip.format), rest(clip.format);
    for (std::size_t t = 0; t < clip.frames.size(); ++t) {
        const ImageTree tree = tree_of(clip.frames[t]);
        all.add(tree, 1);
        (t < 3 ? first : rest).add(tree, 1);
    }
    first.add(rest);
    EXPECT_EQ(first.frames(), 7);
    ExactFrame a, b;
    all.mean_into(a);
    first.mean_into(b);
    EXPECT_EQ(a, b);
}

TEST(ExactMean, AnEmptySumAddsNothing) {
    const RawClip clip = random_clip(20, 20, 1, 61);
    FrameSum sum(clip.format), empty(clip.format);
    sum.add(tree_of(clip.frames[0]), 1);
    sum.add(empty);
    EXPECT_EQ(sum.frames(), 1);
    empty.add(sum);
    ExactFrame a, b;
    sum.mean_into(a);
    empty.mean_into(b);
    EXPECT_EQ(a, b);
    expect_exact(clip, a);
}

TEST(ExactMean, AFrameThatStaysCountsAsOften) {
    RawClip clip = blocks(40, 20, 2, 62);
    FrameSum sum(clip.format);
    sum.add(tree_of(clip.frames[0]), 5);
    sum.add(tree_of(clip.frames[1]), 2);
    EXPECT_EQ(sum.frames(), 7);
    ExactFrame frame;
    sum.mean_into(frame);
    clip.frames.insert(clip.frames.begin(), 4, clip.frames[0]);
    clip.frames.push_back(clip.frames.back());
    expect_exact(clip, frame);
}

TEST(ExactMean, AClearedSumIsAsNew) {
    const RawClip clip = random_clip(30, 20, 2, 63);
    FrameSum sum(clip.format);
    sum.add(tree_of(clip.frames[0]), 3);
    ExactFrame frame;
    sum.mean_into(frame);
    sum.clear();
    EXPECT_EQ(sum.frames(), 0);
    sum.add(tree_of(clip.frames[1]), 1);
    sum.mean_into(frame);
    expect_exact({clip.format, {clip.frames[1]}}, frame);
}

// The mean of a square from the definition, each frame as often as it stays.
Rgba weighted_mean(const RawClip& clip,
                   const std::vector<std::int64_t>& repeats,
                   int block,
                   Edge edge,
                   int x,
                   int y) {
    __extension__ using Wide = __int128;
    std::array<Wide, 4> sums{};
    Wide samples = 0;
    for (std::size_t t = 0; t < clip.frames.size(); ++t) {
        for (int i = 0; i < block * block; ++i) {
            const int u = x * block + i % block, v = y * block + i / block;
            const bool inside = u < clip.format.width && v < clip.format.height;
            if (inside || edge == Edge::kPad) samples += repeats[t];
            if (!inside) continue;
            const Rgba pixel = clip.frames[t].at(u, v);
            const std::array<int, 3> channels = {pixel.r, pixel.g, pixel.b};
            for (std::size_t c = 0; c < 3; ++c) {
                sums[c] += Wide{repeats[t]} * channels[c] * pixel.a;
            }
            sums[3] += Wide{repeats[t]} * pixel.a;
        }
    }
    const auto nearest = [](Wide total, Wide count) {
        return static_cast<std::uint8_t>((2 * total + count) / (2 * count));
    };
    const std::uint8_t alpha = samples == 0 ? 0 : nearest(sums[3], samples);
    if (alpha == 0) return kClear;
    return {nearest(sums[0], sums[3]),
            nearest(sums[1], sums[3]),
            nearest(sums[2], sums[3]),
            alpha};
}

void expect_weighted(const RawClip& clip,
                     const std::vector<std::int64_t>& repeats,
                     const ExactFrame& frame) {
    const ClipShape shape = *ClipShape::make(clip.format, 1);
    for (int level = 0; level <= shape.space_levels(); ++level) {
        const int block = 1 << (shape.space_levels() - level);
        for (const Edge edge : kEdgeRules) {
            for (int y = 0; y < shape.height_at(level); ++y) {
                for (int x = 0; x < shape.width_at(level); ++x) {
                    ASSERT_EQ(pixel_of(frame, edge, level, x, y),
                              weighted_mean(clip, repeats, block, edge, x, y))
                        << "first repeats " << repeats[0] << ", level " << level
                        << ", edge " << int(edge) << ", " << x << " " << y;
                }
            }
        }
    }
}

// Sums of 16, 32 and 64 bits, and every way from one to the next: frames that fill them in
// one step or in many, as trees or as sums, opaque or not, all over or in a corner.
TEST(ExactMean, IsExactHoweverLongTheSumsGet) {
    const std::vector<std::vector<std::int64_t>> stays = {
        {1, 255, 1},
        {1, 256, 1},
        {257, 1, 1},
        {200, 200, 200},
        {1, 2, 32'765},
        {1, 2, 32'766},
        {32'768, 1, 1},
        {100, 40'000, 5},
        {40'000, 40'000, 40'000},
        {16'384, 16'384, 16'384},
        {1, 1'000'000'007, 3},
        {(std::int64_t{1} << 30) - 2, 1, 1},
    };
    std::uint32_t seed = 80;
    for (const std::vector<std::int64_t>& repeats : stays) {
        RawClip mixed = blocks(21, 16, 3, seed += 10);
        for (Rgba& pixel : mixed.frames[0].pixels) pixel.a = 255;
        for (const RawClip& clip : {random_clip(20, 13, 3, ++seed),
                                    opaque(random_clip(9, 16, 3, ++seed)),
                                    opaque(random_clip(32, 32, 3, ++seed)),
                                    opaque(random_clip(3, 2, 3, ++seed)),
                                    mixed}) {
            FrameSum all(clip.format), last(clip.format), joined(clip.format);
            for (std::size_t t = 0; t < 3; ++t) {
                const ImageTree tree = tree_of(clip.frames[t]);
                all.add(tree, repeats[t]);
                (t == 2 ? last : joined).add(tree, repeats[t]);
            }
            joined.add(last);
            ExactFrame frame, same, turned;
            all.mean_into(frame);
            expect_weighted(clip, repeats, frame);
            joined.mean_into(same);
            EXPECT_EQ(same, frame);
            last.clear();
            for (std::size_t t = 3; t-- > 0;)
                last.add(tree_of(clip.frames[t]), repeats[t]);
            last.mean_into(turned);
            EXPECT_EQ(turned, frame);
        }
    }
}

// 2^47 samples, all there may be: of leaves, since no test could hold the pixels.
TEST(ExactMean, OfTheLargestClipIsExact) {
    const FrameFormat format{kMaxSide, kMaxSide, {}};
    const std::vector<LeafSquare> first = {{0, 0, 0, {255, 254, 1, 255}}};
    const std::vector<LeafSquare> second = {{1, 0, 0, {255, 255, 255, 255}},
                                            {16, 65'535, 65'535, {255, 3, 0, 255}}};
    FrameSum sum(format);
    ImageTree tree;
    ASSERT_TRUE(create_frame(first, format, tree).has_value());
    sum.add(tree, 32'767);
    ASSERT_TRUE(create_frame(second, format, tree).has_value());
    sum.add(tree, 1);
    ExactFrame frame;
    sum.mean_into(frame);
    // By hand: all red is 255; of the 2^32 pixels of the second frame 2^30 + 1 are opaque.
    __extension__ using Wide = __int128;
    const Wide pixels = Wide{1} << 32, opaque_pixels = (Wide{1} << 30) + 1;
    const Wide alpha = 255 * (32'767 * pixels + opaque_pixels);
    const Wide green = 255 * (254 * 32'767 * pixels + 255 * (opaque_pixels - 1) + 3);
    const Wide blue = 255 * (32'767 * pixels + 255 * (opaque_pixels - 1));
    const auto nearest = [](Wide total, Wide count) {
        return static_cast<std::uint8_t>((2 * total + count) / (2 * count));
    };
    const Rgba want{255,
                    nearest(green, alpha),
                    nearest(blue, alpha),
                    nearest(alpha, pixels * 32'768)};
    EXPECT_EQ(pixel_of(frame, Edge::kPad, 0, 0, 0), want);
    EXPECT_EQ(pixel_of(frame, Edge::kNormalize, 0, 0, 0), want);
    EXPECT_EQ(frame.bounds, (Bounds{0, 0, kMaxSide, kMaxSide}));
}

}  // namespace
}  // namespace haarmony::video::testing
