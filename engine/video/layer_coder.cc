#include "engine/video/layer_coder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

#include "engine/video/brick_coder.h"
#include "engine/video/byte_stream.h"
#include "engine/video/ref_coder.h"

namespace haarmony::video {
namespace {

// A node's brick and its children.
constexpr std::uint64_t kNodeRefs = 5;

// The order in which a layer's nodes and bricks are coded, and what is known at each.
class LayerCoding {
  public:
    LayerCoding(const LayerSurroundings& surroundings, const LayerSize& size)
        : at_(surroundings),
          level_(surroundings.space_level),
          own_(surroundings.address.time_level),
          places_(places(surroundings)),
          node_known_(size.nodes),
          bricks_of_layer_(size.bricks) {}

    // f(node, place) for every node, until it says false; place is null for one that is
    // shown nowhere.
    template <typename F>
    void each_node(F&& f) {
        for (const Placed& place : places_) {
            if (!f(place.node, &place)) return;
            node_known_[place.node] = 1;
        }
        for (std::uint32_t node = 0; node < node_known_.size(); ++node) {
            if (node_known_[node]) continue;
            if (!f(node, nullptr)) return;
            node_known_[node] = 1;
        }
    }

    // f(brick, place) for every brick by index, in the same way; once all nodes are known. A
    // brick's place is the first in the walk.
    template <typename F>
    void each_brick(F&& f) {
        std::vector<const Placed*> first(bricks_of_layer_, nullptr);
        const LinkedNodes& nodes = at_.layer(own_, level_).nodes;
        for (const Placed& place : places_) {
            const Ref ref = nodes.brick(place.node);
            if (time_level_of(ref) == own_ && first[index_of(ref)] == nullptr)
                first[index_of(ref)] = &place;
        }
        for (known_bricks_ = 0; known_bricks_ < bricks_of_layer_; ++known_bricks_) {
            if (!f(known_bricks_, first[known_bricks_])) return;
        }
    }

    template <typename Io>
    void code_node(Io& io, LinkedNode& node, const Placed* place) {
        const std::optional<LinkedNode> parent =
            known(place == nullptr ? Shown{} : place->parent);
        const std::optional<LinkedNode> first =
            known(place == nullptr ? Shown{} : place->first);
        const std::optional<LinkedNode> other =
            known(place == nullptr ? Shown{} : place->other_edge);
        const auto candidates = [&](Ref next, auto member) {
            Candidates made = kNoCandidates;
            made[kNext] = next;
            if (parent) made[kOfParent] = member(*parent);
            if (first) made[kOfFirst] = member(*first);
            if (other) made[kOfOtherEdge] = member(*other);
            return made;
        };
        io.code(node.brick,
                candidates(bricks_.next(), [](const LinkedNode& n) { return n.brick; }),
                bricks_);
        if (level_ == at_.finest_level) return;
        for (std::size_t q = 0; q < 4; ++q) {
            io.code(node.child[q],
                    candidates(children_.next(),
                               [q](const LinkedNode& n) { return n.child[q]; }),
                    children_);
        }
    }

    // What is around a brick, all that the reference needs or, without one, all that there is.
    [[nodiscard]] const BrickNeighbors& neighbors(const Placed* place,
                                                  const Reference* reference) {
        neighbors_ = {};
        if (place == nullptr) return neighbors_;
        const auto wanted = [reference](std::initializer_list<Reference> by) {
            return reference == nullptr ||
                   std::find(by.begin(), by.end(), *reference) != by.end();
        };
        using enum Reference;
        const std::int32_t x = place->x;
        const std::int32_t y = place->y;
        if (wanted({kParent, kMirror, kParentCoarse}))
            neighbors_.parent = shown(place->parent, level_, x, y, 0);
        if (wanted({kMirror})) neighbors_.first = shown(place->first, level_, x, y, 1);
        if (wanted({kOtherEdge}))
            neighbors_.other_edge = shown(place->other_edge, level_, x, y, 2);
        if (wanted({kCoarse, kParentCoarse}))
            neighbors_.coarse = shown(place->coarse, level_ - 1, x / 2, y / 2, 3);
        if (wanted({kParentCoarse})) {
            neighbors_.parent_coarse =
                shown(place->parent_coarse, level_ - 1, x / 2, y / 2, 4);
        }
        neighbors_.quadrant = (x & 1) + 2 * (y & 1);
        return neighbors_;
    }

  private:
    [[nodiscard]] bool is_own(const Shown& shown) const {
        return shown.level == level_ && time_level_of(shown.node) == own_;
    }
    // The node of this level at a place, if it is decoded.
    [[nodiscard]] std::optional<LinkedNode> known(const Shown& shown) const {
        if (!shown.any() || shown.level != level_) return std::nullopt;
        if (is_own(shown) && !node_known_[index_of(shown.node)]) return std::nullopt;
        return at_.node(level_, shown.node);
    }
    [[nodiscard]] const Brick* shown(const Shown& shown,
                                     int level,
                                     std::int32_t x,
                                     std::int32_t y,
                                     std::size_t buffer) {
        if (!shown.any()) return nullptr;
        const Ref ref = at_.node(shown.level, shown.node).brick;
        const bool own = shown.level == level_ && time_level_of(ref) == own_;
        if (own && index_of(ref) >= known_bricks_) return nullptr;
        Brick& brick = around_[buffer];
        const Bricks& bricks = at_.layer(time_level_of(ref), shown.level).bricks;
        if (shown.level == level) {
            bricks.get(index_of(ref), brick);
        } else {
            bricks.get(index_of(ref), coarser_);
            enlarge(coarser_, level - shown.level, x, y, brick);
        }
        return &brick;
    }

    const LayerSurroundings& at_;
    int level_;
    int own_;
    std::vector<Placed> places_;
    std::vector<std::uint8_t> node_known_;
    std::uint32_t bricks_of_layer_;
    std::uint32_t known_bricks_ = 0;
    RefSequence bricks_{own_};
    RefSequence children_{own_};
    BrickNeighbors neighbors_;
    std::array<Brick, 5> around_;
    Brick coarser_;
};

bool within(const LinkedNode& node,
            const LayerSurroundings& surroundings,
            const LayerSize& size) {
    const int own = surroundings.address.time_level;
    const int at = time_level_of(node.brick);
    if (at > own) return false;
    const std::size_t bricks =
        at == own ? size.bricks
                  : surroundings.layer(at, surroundings.space_level).bricks.size();
    if (index_of(node.brick) >= bricks) return false;
    for (const Ref child : node.child) {
        if (child == kNoDetailRef) continue;
        if (time_level_of(child) > own ||
            index_of(child) >= surroundings.finer_nodes[time_level_of(child)]) {
            return false;
        }
    }
    return true;
}

Error damaged(const std::string& what) { return {ErrorCode::kUndecodable, what}; }

}  // namespace

void put_padding(std::uint64_t memory_bytes, std::vector<std::byte>& chunk) {
    const std::uint64_t least = (memory_bytes + kMostExpansion - 1) / kMostExpansion;
    const std::uint64_t zeros = least > chunk.size() ? least - chunk.size() : 0;
    std::vector<std::byte> padded;
    put_varint(padded, zeros);
    padded.resize(padded.size() + zeros);
    chunk.insert(chunk.begin(), padded.begin(), padded.end());
}

Result<std::span<const std::byte>> without_padding(std::span<const std::byte> chunk,
                                                   std::uint64_t memory_bytes) {
    if (memory_bytes / kMostExpansion > chunk.size()) {
        return damaged(std::to_string(chunk.size()) + " bytes for " +
                       std::to_string(memory_bytes) + " in memory");
    }
    ByteReader in(chunk);
    const std::uint64_t zeros = in.varint();
    if (in.overrun() || zeros > in.rest().size()) return damaged("padding cut off");
    return in.rest().subspan(zeros);
}

std::vector<std::byte> encode_layer(const LayerSurroundings& surroundings) {
    const Layer& layer =
        surroundings.layer(surroundings.address.time_level, surroundings.space_level);
    const LayerSize size{static_cast<std::uint32_t>(layer.nodes.size()),
                         static_cast<std::uint32_t>(layer.bricks.size())};
    assert(!size.empty());
    LayerCoding coding(surroundings, size);
    PutRefs refs;
    coding.each_node([&](std::uint32_t node, const Placed* place) {
        LinkedNode copy = layer.nodes[node];
        coding.code_node(refs, copy, place);
        return true;
    });
    BrickEncoder bricks;
    Brick brick;
    coding.each_brick([&](std::uint32_t index, const Placed* place) {
        layer.bricks.get(index, brick);
        bricks.put(brick, coding.neighbors(place, nullptr));
        return true;
    });
    std::vector<std::byte> chunk;
    refs.finish(chunk);
    bricks.finish(chunk);
    put_padding(size.memory_bytes(), chunk);
    return chunk;
}

Result<void> decode_layer(std::span<const std::byte> chunk,
                          const LayerSize& size,
                          const LayerSurroundings& surroundings,
                          Layer& layer) {
    const auto coded = without_padding(chunk, size.memory_bytes());
    if (!coded) return coded.error();
    StreamReader streams(*coded);
    Result<TakeRefs> refs =
        TakeRefs::open(streams, kNodeRefs * std::uint64_t{size.nodes});
    if (!refs) return std::move(refs).error();
    layer.nodes.assign(size.nodes, {});
    layer.bricks.clear();
    LayerCoding coding(surroundings, size);
    Result<void> decoded;
    coding.each_node([&](std::uint32_t node, const Placed* place) {
        coding.code_node(*refs, layer.nodes[node], place);
        if (!(*refs).damaged() && within(layer.nodes[node], surroundings, size))
            return true;
        decoded = damaged("refs of node " + std::to_string(node));
        return false;
    });
    if (!decoded) return decoded;
    Result<BrickDecoder> bricks = BrickDecoder::open(streams, size.bricks);
    if (!bricks) return std::move(bricks).error();
    layer.bricks.reserve(size.bricks);
    Brick brick;
    coding.each_brick([&](std::uint32_t index, const Placed* place) {
        const std::uint8_t symbol = (*bricks).next_symbol();
        const Reference reference = mode_of(symbol % kModeSymbols).reference;
        const Result<void> read =
            (*bricks).next(symbol, coding.neighbors(place, &reference), brick);
        if (read) {
            layer.bricks.push_back(brick);
            return true;
        }
        decoded = damaged("brick " + std::to_string(index) + ": " + read.error().message);
        return false;
    });
    if (!decoded) return decoded;
    if (!(*refs).at_end() || !(*bricks).at_end() || !streams.at_end())
        return damaged("streams left over or missing");
    return {};
}

}  // namespace haarmony::video
