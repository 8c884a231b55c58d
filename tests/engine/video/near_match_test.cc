#include "engine/video/near_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/engine/video/plain_frame.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::exact_frame;
using testing::pixel_of;
using testing::RawClip;

constexpr int kLevels = 5;
constexpr auto kPad = static_cast<std::size_t>(Edge::kPad);

// An exact frame as the only one of a chain: what is displayed.
Ref show(const ExactFrame& frame, std::uint32_t index, int level, LayerChain& chain) {
    const TreeNode& node = frame.nodes[index];
    LinkedNode shown;
    for (std::size_t q = 0; q < 4; ++q) {
        if (node.child[q] == kNoDetail) continue;
        shown.child[q] = show(frame, node.child[q], level + 1, chain);
    }
    Layer& layer = chain.layers[0][static_cast<std::size_t>(level - kBrickLevel)];
    shown.brick = make_ref(0, static_cast<std::uint32_t>(layer.bricks.size()));
    layer.bricks.push_back(frame.bricks[node.brick]);
    layer.nodes.push_back(shown);
    return make_ref(0, static_cast<std::uint32_t>(layer.nodes.size() - 1));
}

// Smooth squares and a little noise, so that bounds are met at some levels and not at others.
RawClip squares(std::uint32_t seed) {
    std::mt19937 random(seed);
    RawClip clip;
    clip.format = {1 << kLevels, 1 << kLevels, {25, 1}};
    Picture frame(1 << kLevels, 1 << kLevels);
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const auto noise =
                static_cast<std::uint8_t>(x < 16 && y < 16 ? random() % 3 : 0);
            frame.at(x, y) = {
                static_cast<std::uint8_t>(40 * (x / 16) + noise),
                static_cast<std::uint8_t>(40 * (y / 16)),
                noise,
                static_cast<std::uint8_t>(x < 8 ? 254 + random() % 2 : 255)};
        }
    }
    clip.frames.push_back(frame);
    return clip;
}

// The largest difference from level 3 down.
std::uint32_t worst(const ExactFrame& a, const ExactFrame& b) {
    std::uint32_t largest = 0;
    for (int level = kBrickLevel; level <= kLevels; ++level) {
        for (int y = 0; y < 1 << level; ++y) {
            for (int x = 0; x < 1 << level; ++x) {
                largest = std::max(largest,
                                   difference(pixel_of(a, Edge::kPad, level, x, y),
                                              pixel_of(b, Edge::kPad, level, x, y)));
            }
        }
    }
    return largest;
}

TEST(NearMatch, ShowsExactlyWhereNoPixelOfAnyLevelIsFarther) {
    std::mt19937 random(1);
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        RawClip clip = squares(seed);
        const ExactFrame shown = exact_frame(clip, {0, 0});
        // Single pixels are changed, also where the shown frame is flat.
        for (std::uint32_t changes = 0; changes < seed % 4; ++changes) {
            Rgba& pixel = clip.frames[0].pixels[random() % clip.frames[0].pixels.size()];
            pixel.b = static_cast<std::uint8_t>(pixel.b + 1 + random() % 20);
        }
        const ExactFrame exact = exact_frame(clip, {0, 0});
        LayerChain chain;
        chain.layers.emplace_back(kLevels - kBrickLevel + 1);
        const Ref root = show(shown, shown.root[kPad], kBrickLevel, chain);
        const std::uint32_t largest = worst(exact, shown);
        NearMatch match(chain, largest);
        match.begin(exact);
        EXPECT_TRUE(match.shows(root, exact.root[kPad], kBrickLevel)) << seed;
        if (largest == 0) continue;
        NearMatch narrower(chain, largest - 1);
        narrower.begin(exact);
        EXPECT_FALSE(narrower.shows(root, exact.root[kPad], kBrickLevel)) << seed;
        // The other way round: detail that is shown where the exact frame is flat.
        LayerChain other;
        other.layers.emplace_back(kLevels - kBrickLevel + 1);
        const Ref other_root = show(exact, exact.root[kPad], kBrickLevel, other);
        NearMatch back(other, largest);
        back.begin(shown);
        EXPECT_TRUE(back.shows(other_root, shown.root[kPad], kBrickLevel)) << seed;
        NearMatch narrower_back(other, largest - 1);
        narrower_back.begin(shown);
        EXPECT_FALSE(narrower_back.shows(other_root, shown.root[kPad], kBrickLevel));
    }
}

TEST(NearMatch, FlatIsTheLargestDifferenceFromTheSquareAboveAtAnyLevel) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const ExactFrame exact = exact_frame(squares(seed), {0, 0});
        const TreeNode& root = exact.nodes[exact.root[kPad]];
        const LayerChain chain;
        for (int q = 0; q < 4; ++q) {
            if (root.child[static_cast<std::size_t>(q)] == kNoDetail) continue;
            std::uint32_t largest = 0;
            for (int level = kBrickLevel + 1; level <= kLevels; ++level) {
                const int half = 1 << (level - 1);
                const int down = level - kBrickLevel;
                for (int y = half * (q / 2); y < half * (q / 2 + 1); ++y) {
                    for (int x = half * (q % 2); x < half * (q % 2 + 1); ++x) {
                        largest = std::max(
                            largest,
                            difference(
                                pixel_of(exact, Edge::kPad, level, x, y),
                                pixel_of(exact, Edge::kPad, 3, x >> down, y >> down)));
                    }
                }
            }
            ASSERT_GT(largest, 0U);
            for (const bool enough : {true, false}) {
                NearMatch match(chain, enough ? largest : largest - 1);
                match.begin(exact);
                EXPECT_EQ(match.flat(exact.bricks[root.brick],
                                     q,
                                     root.child[static_cast<std::size_t>(q)]),
                          enough);
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::video
