// Chunks of layers and of time nodes by themselves: what they cost, and what is refused.
#include "engine/video/layer_coder.h"

#include <gtest/gtest.h>

#include "engine/video/brick_coder.h"
#include "engine/video/byte_stream.h"
#include "engine/video/ref_coder.h"
#include "engine/video/time_node_coder.h"

namespace haarmony::video {
namespace {

constexpr LayerSize kTwo{2, 2};

// Siblings (1, 0) of a clip with space levels 3 and 4, below a root of two nodes and two
// bricks at each.
struct Setting {
    std::vector<Layer> top{2};
    std::vector<Layer> own{2};
    SiblingNodes top_nodes;
    SiblingNodes nodes;

    Setting() {
        for (std::size_t level = 0; level < 2; ++level) {
            for (std::uint32_t i = 0; i < 2; ++i) {
                LinkedNode node;
                node.brick = make_ref(0, i);
                if (level == 0) node.child.fill(make_ref(0, 1 - i));
                top[level].nodes.push_back(node);
                node.brick = make_ref(1, i);
                if (level == 0) node.child.fill(make_ref(1, i));
                own[level].nodes.push_back(node);
                Brick brick;
                brick.fill({static_cast<std::uint8_t>(50 * i), 9, 7, 255});
                top[level].bricks.push_back(brick);
                brick.fill({200, static_cast<std::uint8_t>(50 * i), 7, 255});
                own[level].bricks.push_back(brick);
            }
        }
        top_nodes.count = 1;
        top_nodes.node[0].root = {make_ref(0, 0), make_ref(0, 1)};
        nodes.count = 2;
        nodes.node[0].root = {make_ref(1, 0), make_ref(1, 0)};
        nodes.node[1].root = {make_ref(1, 1), make_ref(0, 1)};
    }

    [[nodiscard]] LayerSurroundings at(int level, const Layer& own_layer) const {
        LayerSurroundings made;
        made.address = {1, 0};
        made.space_level = level;
        made.finest_level = 4;
        made.nodes = &nodes;
        made.time_parent = &top_nodes.node[0];
        made.layers.resize(2);
        for (int l = kBrickLevel; l <= level; ++l) {
            made.layers[0].push_back(&top[static_cast<std::size_t>(l - kBrickLevel)]);
            made.layers[1].push_back(&own[static_cast<std::size_t>(l - kBrickLevel)]);
        }
        made.layers[1].back() = &own_layer;
        if (level == 3) made.finer_nodes = {2, 2};
        return made;
    }
};

Result<void> decoded(const Setting& setting,
                     int level,
                     const std::vector<std::byte>& chunk,
                     const LayerSize& size,
                     Layer& layer) {
    return decode_layer(chunk, size, setting.at(level, layer), layer);
}

std::vector<std::byte> encoded(const Setting& setting, int level, const Layer& layer) {
    return encode_layer(setting.at(level, layer));
}

TEST(LayerCoder, LayersComeBack) {
    const Setting setting;
    for (const int level : {3, 4}) {
        const Layer& layer = setting.own[static_cast<std::size_t>(level - kBrickLevel)];
        Layer back;
        const Result<void> done =
            decoded(setting, level, encoded(setting, level, layer), kTwo, back);
        ASSERT_TRUE(done.has_value()) << done.error().message;
        EXPECT_EQ(back, layer);
    }
}

// An encoder says what it is told; a decoder must not believe it.
TEST(LayerCoder, RefsOutsideOfTheirLayersAreRefused) {
    struct Wrong {
        bool child;
        Ref ref;
    };
    for (const Wrong& wrong : {Wrong{false, make_ref(1, 2)},
                               Wrong{false, make_ref(0, 2)},
                               Wrong{true, make_ref(1, 2)},
                               Wrong{true, make_ref(0, 2)},
                               Wrong{true, make_ref(1, kMaxRefIndex)}}) {
        const Setting setting;
        // Not shown anywhere, so that writing it does not follow its refs.
        Layer layer = setting.own[0];
        Setting unseen = setting;
        unseen.nodes.node[0].root = {make_ref(0, 0), make_ref(0, 0)};
        unseen.nodes.node[1].root = {make_ref(0, 0), make_ref(0, 0)};
        if (wrong.child) {
            layer.nodes[1].child[2] = wrong.ref;
        } else {
            layer.nodes[1].brick = wrong.ref;
        }
        Layer back;
        const Result<void> done =
            decoded(unseen, 3, encoded(unseen, 3, layer), kTwo, back);
        ASSERT_FALSE(done.has_value());
        EXPECT_EQ(done.error().code, ErrorCode::kUndecodable);
        EXPECT_EQ(done.error().message, "refs of node 1");
    }
}

TEST(LayerCoder, ANodeWithoutABrickIsRefused) {
    const Setting setting;
    Setting unseen = setting;
    unseen.nodes.node[0].root = {make_ref(0, 0), make_ref(0, 0)};
    unseen.nodes.node[1].root = {make_ref(0, 0), make_ref(0, 0)};
    Layer layer = setting.own[0];
    layer.nodes[0].brick = kNoDetailRef;
    Layer back;
    const Result<void> done = decoded(unseen, 3, encoded(unseen, 3, layer), kTwo, back);
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().message, "refs of node 0");
}

TEST(LayerCoder, OtherSizesThanTheChunksAreRefused) {
    const Setting setting;
    const std::vector<std::byte> chunk = encoded(setting, 4, setting.own[1]);
    for (const LayerSize& size : {LayerSize{3, 2}, LayerSize{2, 1}, LayerSize{2, 3}}) {
        Layer back;
        EXPECT_FALSE(decoded(setting, 4, chunk, size, back).has_value()) << size.bricks;
    }
}

// Coding order is the order of the bricks' numbers: what a brick is predicted from comes before
// it, wherever it is shown.
TEST(LayerCoder, BricksShownInAnyOrderComeBack) {
    Setting setting;
    std::swap(setting.own[0].nodes[0].brick, setting.own[0].nodes[1].brick);
    const Layer& layer = setting.own[0];
    Layer back;
    const Result<void> done = decoded(setting, 3, encoded(setting, 3, layer), kTwo, back);
    ASSERT_TRUE(done.has_value()) << done.error().message;
    EXPECT_EQ(back, layer);
}

TEST(LayerCoder, ChunksAreTheSameWhateverWasCodedBefore) {
    const Setting setting;
    const std::vector<std::byte> alone = encoded(setting, 4, setting.own[1]);
    (void)encoded(setting, 3, setting.own[0]);
    EXPECT_EQ(encoded(setting, 4, setting.own[1]), alone);
}

TEST(LayerCoder, MoreThanAChunkCanHoldIsNotAllocated) {
    const Setting setting;
    const std::vector<std::byte> chunk = encoded(setting, 4, setting.own[1]);
    Layer back;
    const Result<void> done = decoded(setting, 4, chunk, {2, kMaxRefIndex}, back);
    ASSERT_FALSE(done.has_value());
    EXPECT_NE(done.error().message.find("bytes for"), std::string::npos);
    EXPECT_TRUE(back.bricks.empty());
}

TEST(LayerCoder, PaddingIsAsLongAsExpansionAsksFor) {
    std::vector<std::byte> chunk(10, std::byte{5});
    put_padding(100 * kMostExpansion, chunk);
    EXPECT_EQ(chunk.size(), 101U);
    const auto body = without_padding(chunk, 100 * kMostExpansion);
    ASSERT_TRUE(body.has_value());
    EXPECT_EQ((*body).size(), 10U);
    EXPECT_FALSE(without_padding(chunk, 102 * kMostExpansion).has_value());
    chunk[0] = std::byte{101};
    const auto cut = without_padding(chunk, 1);
    ASSERT_FALSE(cut.has_value());
    EXPECT_EQ(cut.error().message, "padding cut off");
}

// The chunk of a layer at level 4 whose bricks have these modes and no residuals.
std::vector<std::byte> chunk_of_modes(const Setting& setting, const Stream& modes) {
    // Refs as a writer puts them; the rest anew.
    const std::vector<std::byte> whole = encoded(setting, 4, setting.own[1]);
    const auto body = without_padding(whole, kTwo.memory_bytes());
    EXPECT_TRUE(body.has_value());
    StreamReader streams(*body);
    std::vector<std::byte> chunk;
    for (int i = 0; i < 2; ++i) {
        const Result<Stream> refs = streams.next(1000);
        EXPECT_TRUE(refs.has_value());
        put_stream(*refs, Redundancy::kRepeated, chunk);
    }
    put_stream(modes, Redundancy::kFrequent, chunk);
    RowWriter().finish(chunk);
    put_padding(kTwo.memory_bytes(), chunk);
    return chunk;
}

TEST(LayerCoder, ModesWithoutTheirReferencesAreRefused) {
    // The first brick is shown in the first half, below a brick and beside the time-parent's.
    for (int symbol = 0; symbol < 256; ++symbol) {
        const Setting setting;
        const BrickMode mode = mode_of(symbol % kModeSymbols);
        const BrickMode none{.reference = Reference::kBefore,
                             .follows_green = false,
                             .alpha = AlphaMode::kOpaque,
                             .exact = true};
        const bool known = is_mode(symbol) && mode.reference != Reference::kMirror &&
                           mode.reference != Reference::kOtherEdge;
        Layer back;
        const Result<void> done = decoded(
            setting,
            4,
            chunk_of_modes(setting, {static_cast<std::uint8_t>(symbol), none.symbol()}),
            kTwo,
            back);
        ASSERT_EQ(done.has_value(), known && mode.exact) << symbol;
        if (done) continue;
        EXPECT_EQ(done.error().message,
                  known ? "streams left over or missing"
                        : "brick 0: mode " + std::to_string(symbol));
    }
}

TEST(LayerCoder, AModeForEveryBrickIsAskedFor) {
    const Setting setting;
    for (const std::size_t modes : {1U, 3U}) {
        Layer back;
        const Result<void> done =
            decoded(setting, 4, chunk_of_modes(setting, Stream(modes, 1)), kTwo, back);
        ASSERT_FALSE(done.has_value()) << modes;
        EXPECT_EQ(done.error().message,
                  modes == 1 ? "1 modes for 2 bricks"
                             : "stream of 3 bytes, at most 2 expected");
    }
}

// What a reader makes of one ref, of siblings at time level 2.
TakeRefs one_taken(const Stream& kinds, const Stream& spelled, Ref& ref) {
    std::vector<std::byte> bytes;
    put_stream(kinds, Redundancy::kRepeated, bytes);
    put_stream(spelled, Redundancy::kRepeated, bytes);
    StreamReader streams(bytes);
    Result<TakeRefs> refs = TakeRefs::open(streams, 2);
    EXPECT_TRUE(refs.has_value());
    RefSequence sequence(2);
    (*refs).code(ref, kNoCandidates, sequence);
    return *std::move(refs);
}

TEST(RefCoder, RefsSpelledOutComeBack) {
    Ref ref{};
    const TakeRefs refs = one_taken({kExplicit}, {9, 1, 0, 0, 2}, ref);
    EXPECT_TRUE(refs.at_end());
    EXPECT_EQ(ref, make_ref(0, 265));
}

TEST(RefCoder, KindsThatAreNoneAreDamage) {
    Ref ref{};
    EXPECT_TRUE(one_taken({kExplicit + 1}, {}, ref).damaged());
    // Three levels up from level 2 there is nothing.
    EXPECT_TRUE(one_taken({kExplicit}, {0, 0, 0, 0, 3}, ref).damaged());
    EXPECT_TRUE(one_taken({kExplicit}, {0, 0, 0, 0, 255}, ref).damaged());
    // No layer has so many.
    EXPECT_TRUE(one_taken({kExplicit}, {255, 255, 255, 7, 0}, ref).damaged());
    EXPECT_EQ(ref, kNoDetailRef);
}

TEST(RefCoder, RefsThatAreMissingOrLeftOverAreDamage) {
    Ref ref{};
    EXPECT_TRUE(one_taken({}, {}, ref).damaged());
    EXPECT_TRUE(one_taken({kExplicit}, {0, 0, 0, 0}, ref).damaged());
    EXPECT_FALSE(one_taken({kNext, kNext}, {}, ref).at_end());
    EXPECT_FALSE(one_taken({kNext}, {0}, ref).at_end());
    EXPECT_TRUE(one_taken({kNext}, {}, ref).at_end());
}

TimeNodeSurroundings below_root(const Setting& setting) {
    return {.shape = *ClipShape::make({16, 16, {25, 1}}, 2),
            .address = {1, 0},
            .time_parent = &setting.top_nodes.node[0],
            .root_nodes = {2, 2}};
}

TEST(TimeNodeCoder, RootsAndBoundsOutsideAreRefused) {
    const Setting setting;
    for (int wrong = 0; wrong < 4; ++wrong) {
        SiblingNodes nodes = setting.nodes;
        if (wrong == 1) nodes.node[0].root[1] = make_ref(1, 2);
        if (wrong == 2) nodes.node[1].root[0] = kNoDetailRef;
        if (wrong == 3) nodes.node[1].bounds = {0, 0, 17, 16};
        const auto chunk = encode_time_nodes(nodes, below_root(setting));
        SiblingNodes back;
        const Result<void> done = decode_time_nodes(chunk, below_root(setting), back);
        ASSERT_EQ(done.has_value(), wrong == 0);
        if (done) {
            EXPECT_EQ(back, nodes);
        } else {
            EXPECT_EQ(done.error().message,
                      "roots or bounds of half " + std::to_string(wrong / 2));
        }
    }
}

TEST(TimeNodeCoder, TheSecondHalfIsThereWhereFramesAreLeft) {
    const ClipShape shape = *ClipShape::make({16, 16, {25, 1}}, 5);
    EXPECT_EQ(sibling_count(shape, {0, 0}), 1);
    EXPECT_EQ(sibling_count(shape, {1, 0}), 2);
    EXPECT_EQ(sibling_count(shape, {2, 1}), 1);
    EXPECT_EQ(sibling_count(shape, {3, 1}), 2);
    EXPECT_EQ(sibling_count(shape, {3, 2}), 1);
}

}  // namespace
}  // namespace haarmony::video
