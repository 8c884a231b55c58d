#include "engine/video/layer_coder.h"

#include <array>
#include <cassert>
#include <optional>
#include <span>
#include <string>

#include "engine/video/brick_coder.h"
#include "engine/video/byte_stream.h"
#include "engine/video/ref_coder.h"

namespace haarmony::video {
namespace {

// The order in which a layer's nodes and bricks are coded, and what is known at each.
class LayerCoding {
  public:
    // `bricks` are the layer's own, as far as they are known.
    LayerCoding(const LayerSurroundings& surroundings,
                const LayerSize& size,
                std::span<const Brick> bricks)
        : at_(surroundings),
          level_(surroundings.space_level),
          own_(surroundings.address.time_level),
          own_bricks_(bricks),
          places_(places(surroundings)),
          node_known_(size.nodes),
          brick_known_(size.bricks) {}

    // f(node, place) for every node, until it says false; place is null for one that is
    // shown nowhere.
    template <typename F>
    void each_node(F&& f) {
        for (const Placed& place : places_) {
            if (!f(place.node, &place)) return;
            node_known_[place.node] = true;
        }
        for (std::uint32_t node = 0; node < node_known_.size(); ++node) {
            if (node_known_[node]) continue;
            if (!f(node, nullptr)) return;
            node_known_[node] = true;
        }
    }

    // f(brick, place) in the same way; once all nodes are known.
    template <typename F>
    void each_brick(F&& f) {
        for (const Placed& place : places_) {
            const Ref ref = at_.layer(own_, level_).nodes[place.node].brick;
            if (time_level_of(ref) != own_ || brick_known_[index_of(ref)]) continue;
            if (!f(index_of(ref), &place)) return;
            brick_known_[index_of(ref)] = true;
        }
        for (std::uint32_t brick = 0; brick < brick_known_.size(); ++brick) {
            if (brick_known_[brick]) continue;
            if (!f(brick, nullptr)) return;
            brick_known_[brick] = true;
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
                kBrickRefContext,
                bricks_);
        if (level_ == at_.finest_level) return;
        for (std::size_t q = 0; q < 4; ++q) {
            io.code(node.child[q],
                    candidates(children_.next(),
                               [q](const LinkedNode& n) { return n.child[q]; }),
                    kChildRefContext,
                    children_);
        }
    }

    [[nodiscard]] const BrickNeighbors& neighbors(const Placed* place) {
        neighbors_ = {};
        if (place == nullptr) return neighbors_;
        const std::int32_t x = place->x;
        const std::int32_t y = place->y;
        neighbors_.parent = shown(place->parent, level_, x, y, 0);
        neighbors_.first = shown(place->first, level_, x, y, 1);
        neighbors_.other_edge = shown(place->other_edge, level_, x, y, 2);
        neighbors_.left = shown(place->left, level_, x - 1, y, 3);
        neighbors_.above = shown(place->above, level_, x, y - 1, 4);
        neighbors_.coarse = shown(place->coarse, level_ - 1, x / 2, y / 2, 5);
        neighbors_.parent_coarse =
            shown(place->parent_coarse, level_ - 1, x / 2, y / 2, 6);
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
        if (shown.level == level_ && time_level_of(ref) == own_) {
            return brick_known_[index_of(ref)] ? &own_bricks_[index_of(ref)] : nullptr;
        }
        Brick& brick = around_[buffer];
        brick = at_.brick(shown.level, ref);
        if (shown.level < level) {
            const Brick coarser = brick;
            enlarge(coarser, level - shown.level, x, y, brick);
        }
        return &brick;
    }

    const LayerSurroundings& at_;
    int level_;
    int own_;
    std::span<const Brick> own_bricks_;
    std::vector<Placed> places_;
    std::vector<bool> node_known_;
    std::vector<bool> brick_known_;
    RefSequence bricks_{own_};
    RefSequence children_{own_};
    BrickNeighbors neighbors_;
    std::array<Brick, 7> around_;  // those that are not the layer's own
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

std::vector<std::byte> encode_layer(const LayerSurroundings& surroundings,
                                    SymbolCosts& costs) {
    const Layer& layer =
        surroundings.layer(surroundings.address.time_level, surroundings.space_level);
    const LayerSize size{static_cast<std::uint32_t>(layer.nodes.size()),
                         static_cast<std::uint32_t>(layer.bricks.size())};
    assert(!size.empty());
    std::vector<Brick> own(size.bricks);
    for (std::size_t i = 0; i < own.size(); ++i) layer.bricks.get(i, own[i]);
    SymbolWriter symbols;
    LayerCoding coding(surroundings, size, own);
    PutRefs refs(symbols);
    coding.each_node([&](std::uint32_t node, const Placed* place) {
        LinkedNode copy = layer.nodes[node];
        coding.code_node(refs, copy, place);
        return true;
    });
    BrickEncoder bricks(symbols, costs);
    coding.each_brick([&](std::uint32_t brick, const Placed* place) {
        bricks.put(own[brick], coding.neighbors(place));
        return true;
    });
    std::vector<std::byte> chunk;
    symbols.finish(chunk, costs);
    put_padding(size.memory_bytes(), chunk);
    return chunk;
}

Result<void> decode_layer(std::span<const std::byte> chunk,
                          const LayerSize& size,
                          const LayerSurroundings& surroundings,
                          Layer& layer) {
    const auto coded = without_padding(chunk, size.memory_bytes());
    if (!coded) return coded.error();
    auto symbols = SymbolReader::open(*coded);
    if (!symbols) return std::move(symbols).error();
    layer.nodes.assign(size.nodes, {});
    layer.bricks.clear();
    // They come in the order in which they are shown.
    std::vector<Brick> own(size.bricks);
    LayerCoding coding(surroundings, size, own);
    TakeRefs refs(symbols->cursor());
    Result<void> decoded;
    coding.each_node([&](std::uint32_t node, const Placed* place) {
        coding.code_node(refs, layer.nodes[node], place);
        if (!refs.damaged() && within(layer.nodes[node], surroundings, size)) return true;
        decoded = damaged("refs of node " + std::to_string(node));
        return false;
    });
    if (!decoded) return decoded;
    BrickDecoder bricks(symbols->cursor());
    coding.each_brick([&](std::uint32_t brick, const Placed* place) {
        decoded = bricks.next(own[brick], coding.neighbors(place));
        return decoded.has_value();
    });
    if (!decoded) return decoded;
    if (!symbols->at_end()) return damaged("symbols left over or missing");
    layer.bricks.reserve(own.size());
    for (const Brick& brick : own) layer.bricks.push_back(brick);
    return {};
}

}  // namespace haarmony::video
