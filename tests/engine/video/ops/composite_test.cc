// Porter and Duff's operators, on pixels against their definition and on trees against
// pixels.
#include "engine/video/ops/composite.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/video/tree_writer.h"
#include "tests/engine/video/ops/plain_trees.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::is_pruned;
using testing::picture_of;
using testing::random_tree;

constexpr std::size_t kOperators = kOperatorNames.size();

// Porter and Duff's table: what a and b are multiplied with.
std::pair<int, int> fractions(std::size_t op, int alpha_a, int alpha_b) {
    switch (op) {
        case 0:
            return {0, 0};
        case 1:
            return {255, 0};
        case 2:
            return {0, 255};
        case 3:
            return {255, 255 - alpha_a};
        case 4:
            return {255 - alpha_b, 255};
        case 5:
            return {alpha_b, 0};
        case 6:
            return {0, alpha_a};
        case 7:
            return {255 - alpha_b, 0};
        case 8:
            return {0, 255 - alpha_a};
        case 9:
            return {alpha_b, 255 - alpha_a};
        case 10:
            return {255 - alpha_b, alpha_a};
        default:
            return {255 - alpha_b, 255 - alpha_a};
    }
}

Rgba by_definition(Rgba a, Rgba b, std::size_t op) {
    const auto [fa, fb] = fractions(op, a.a, b.a);
    const long long an = fa * a.a + fb * b.a;
    const long long alpha = (2 * an + 255) / 510;
    if (alpha == 0) return {};
    const auto channel = [&, fa = fa, fb = fb](int ca, int cb) {
        const long long cn = 1LL * fa * a.a * ca + 1LL * fb * b.a * cb;
        return static_cast<std::uint8_t>((2 * cn + an) / (2 * an));
    };
    return {channel(a.r, b.r),
            channel(a.g, b.g),
            channel(a.b, b.b),
            static_cast<std::uint8_t>(alpha)};
}

TEST(Composite, PixelsAreAsDefinedForAllAlphas) {
    for (std::size_t op = 0; op < kOperators; ++op) {
        for (int alpha_a = 0; alpha_a < 256; ++alpha_a) {
            for (int alpha_b = 0; alpha_b < 256; ++alpha_b) {
                const Rgba a =
                    canonical({201, 0, 17, static_cast<std::uint8_t>(alpha_a)});
                const Rgba b =
                    canonical({3, 255, 18, static_cast<std::uint8_t>(alpha_b)});
                ASSERT_EQ(composite(a, b, static_cast<Operator>(op)),
                          by_definition(a, b, op))
                    << kOperatorNames[op] << " " << alpha_a << " " << alpha_b;
            }
        }
    }
}

TEST(Composite, BackIsForthWithThePixelsExchanged) {
    const std::vector<std::pair<Operator, Operator>> pairs = {
        {Operator::kA, Operator::kB},
        {Operator::kAOverB, Operator::kBOverA},
        {Operator::kAInB, Operator::kBInA},
        {Operator::kAOutB, Operator::kBOutA},
        {Operator::kAAtopB, Operator::kBAtopA},
        {Operator::kXor, Operator::kXor}};
    const Rgba a{10, 20, 30, 77}, b{200, 100, 0, 130};
    for (const auto& [forth, back] : pairs) {
        EXPECT_EQ(composite(a, b, forth), composite(b, a, back)) << name_of(forth);
    }
}

TEST(Composite, OperatorsAreFoundByTheirNames) {
    for (std::size_t op = 0; op < kOperators; ++op) {
        const Result<Operator> parsed = parse_operator(kOperatorNames[op]);
        ASSERT_TRUE(parsed.has_value()) << kOperatorNames[op];
        EXPECT_EQ(static_cast<std::size_t>(*parsed), op);
        EXPECT_EQ(name_of(*parsed), kOperatorNames[op]);
    }
}

TEST(Composite, AWordThatIsNoOperatorIsNamed) {
    const Result<Operator> parsed = parse_operator("a_under_b");
    ASSERT_FALSE(parsed.has_value());
    EXPECT_EQ(parsed.error().param, "op");
    EXPECT_NE(parsed.error().message.find("a_under_b"), std::string::npos);
    EXPECT_NE(parsed.error().message.find("a_over_b"), std::string::npos);
}

TEST(Composite, TreesEqualTheirPixels) {
    for (const int side : {1, 3, 8, 37, 64}) {
        const FrameFormat format{side, (side + 1) / 2, {25, 1}};
        const ImageTree a = random_tree(format, 11), b = random_tree(format, 12);
        const Picture pa = picture_of(a, format), pb = picture_of(b, format);
        for (std::size_t op = 0; op < kOperators; ++op) {
            ImageTree out;
            composite(a, b, static_cast<Operator>(op), out);
            Picture want(format.width, format.height);
            for (std::size_t i = 0; i < want.pixels.size(); ++i) {
                want.pixels[i] = by_definition(pa.pixels[i], pb.pixels[i], op);
            }
            ASSERT_EQ(picture_of(out, format), want) << side << " " << kOperatorNames[op];
            ASSERT_TRUE(is_pruned(out)) << side << " " << kOperatorNames[op];
        }
    }
}

TEST(Composite, DetailThatIsHiddenIsGone) {
    const FrameFormat format{64, 64, {25, 1}};
    const ImageTree detailed = random_tree(format, 4);
    ImageTree opaque;
    TreePart grey;
    grey.pixels.fill({9, 9, 9, 255});
    TreeWriter(opaque).finish(grey);
    ImageTree out;
    composite(opaque, detailed, Operator::kAOverB, out);
    EXPECT_EQ(out.nodes.size(), 1U);
}

TEST(Composite, VisitsAreLinearInTheSquaresOfBoth) {
    for (int side = 32; side <= 512; side *= 2) {
        const FrameFormat format{side, side, {25, 1}};
        const ImageTree a = random_tree(format, 21), b = random_tree(format, 22);
        ImageTree out;
        const Visited visited = composite(a, b, Operator::kXor, out);
        const auto nodes = static_cast<std::int64_t>(a.nodes.size() + b.nodes.size());
        // A square is visited where at least one of the two trees has a node.
        EXPECT_LE(visited.written, nodes);
        EXPECT_GE(2 * visited.written, nodes);
        EXPECT_EQ(visited.read, 2 * visited.written);
    }
}

}  // namespace
}  // namespace haarmony::video
