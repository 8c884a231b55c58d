#include "engine/video/time_node_coder.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "engine/video/ref_coder.h"

namespace haarmony::video {
namespace {

enum BoundsKind : std::uint8_t { kBoundsOfParent, kBoundsOfFirst, kBoundsCoded };
// A kind, bounds and all pixels, of two halves.
constexpr std::uint64_t kMostBytes = 2 * (1 + 16 + kEdges * kApexPixels * 4);

class Put {
  public:
    void byte(std::uint8_t& value) { bytes_.push_back(value); }
    void residual(int predicted, std::uint8_t& value) {
        bytes_.push_back(static_cast<std::uint8_t>(value - predicted));
    }
    std::vector<std::byte> finish() {
        std::vector<std::byte> chunk;
        refs.finish(chunk);
        put_stream(bytes_, Redundancy::kFrequent, chunk);
        return chunk;
    }
    PutRefs refs;

  private:
    Stream bytes_;
};

// Past the end of the bytes are zeros.
class Take {
  public:
    Take(TakeRefs taken, Stream bytes)
        : refs(std::move(taken)), bytes_(std::move(bytes)) {}
    void byte(std::uint8_t& value) { value = next(); }
    void residual(int predicted, std::uint8_t& value) {
        value = static_cast<std::uint8_t>(predicted + next());
    }
    [[nodiscard]] bool at_end() const { return refs.at_end() && next_ == bytes_.size(); }
    TakeRefs refs;

  private:
    std::uint8_t next() {
        const std::size_t at = next_++;
        return at < bytes_.size() ? bytes_[at] : 0;
    }

    Stream bytes_;
    std::size_t next_ = 0;
};

constexpr int clamped(int value) { return std::min(std::max(value, 0), 255); }

// What a pixel of the apex is enlarged to: one level up.
constexpr int pixel_above(int pixel) {
    if (pixel < apex_offset(2)) return 0;
    const int x = (pixel - apex_offset(2)) % 4;
    const int y = (pixel - apex_offset(2)) / 4;
    return apex_offset(1) + y / 2 * 2 + x / 2;
}

struct Around {
    const TimeNode* parent = nullptr;
    const TimeNode* first = nullptr;
};

Rgba predicted(const Around& around, const TimeNode& node, int edge, int pixel) {
    Rgba from{128, 128, 128, 255};
    if (around.parent != nullptr) {
        from = around.parent->apex[edge][pixel];
        if (around.first != nullptr) {
            const Rgba half = around.first->apex[edge][pixel];
            const auto mirrored = [](std::uint8_t mean, std::uint8_t value) {
                return static_cast<std::uint8_t>(clamped(2 * mean - value));
            };
            from = {mirrored(from.r, half.r),
                    mirrored(from.g, half.g),
                    mirrored(from.b, half.b),
                    mirrored(from.a, half.a)};
        }
    } else if (pixel > 0) {
        from = node.apex[edge][pixel_above(pixel)];
    }
    if (edge == 1) {
        // The two rules differ in alpha alone.
        const Rgba padded = node.apex[0][pixel];
        if (padded.a != 0) from = {padded.r, padded.g, padded.b, from.a};
    }
    return from;
}

template <typename Io>
void code_bounds(Io& io, Bounds& bounds, const Around& around) {
    std::uint8_t kind =
        around.parent != nullptr && bounds == around.parent->bounds ? kBoundsOfParent
        : around.first != nullptr && bounds == around.first->bounds ? kBoundsOfFirst
                                                                    : kBoundsCoded;
    io.byte(kind);
    if (kind == kBoundsOfParent && around.parent != nullptr) {
        bounds = around.parent->bounds;
    } else if (kind == kBoundsOfFirst && around.first != nullptr) {
        bounds = around.first->bounds;
    } else {
        for (std::int32_t* side :
             {&bounds.left, &bounds.top, &bounds.right, &bounds.bottom}) {
            auto bits = static_cast<std::uint32_t>(*side);
            std::uint32_t coded = 0;
            for (int i = 0; i < 4; ++i) {
                auto byte = static_cast<std::uint8_t>(bits >> 8 * i);
                io.byte(byte);
                coded |= std::uint32_t{byte} << 8 * i;
            }
            *side = static_cast<std::int32_t>(coded);
        }
    }
}

template <typename Io>
void code_node(Io& io, TimeNode& node, const Around& around, RefSequence& roots) {
    for (int edge = 0; edge < kEdges; ++edge) {
        Candidates candidates = kNoCandidates;
        candidates[kNext] = roots.next();
        if (around.parent != nullptr) candidates[kOfParent] = around.parent->root[edge];
        if (around.first != nullptr) candidates[kOfFirst] = around.first->root[edge];
        if (edge == 1) candidates[kOfOtherEdge] = node.root[0];
        io.refs.code(node.root[edge], candidates, roots);
    }
    code_bounds(io, node.bounds, around);
    for (int edge = 0; edge < kEdges; ++edge) {
        for (int pixel = 0; pixel < kApexPixels; ++pixel) {
            const Rgba from = predicted(around, node, edge, pixel);
            Rgba& value = node.apex[edge][pixel];
            io.residual(from.a, value.a);
            if (value.a == 0) {
                value = kClear;
                continue;
            }
            io.residual(from.g, value.g);
            const int follow = value.g - from.g;
            io.residual(clamped(from.r + follow), value.r);
            io.residual(clamped(from.b + follow), value.b);
        }
    }
}

template <typename Io>
void code_nodes(Io& io, SiblingNodes& nodes, const TimeNodeSurroundings& surroundings) {
    RefSequence roots(surroundings.address.time_level);
    for (int half = 0; half < nodes.count; ++half) {
        const Around around{surroundings.time_parent,
                            half == 1 ? &nodes.node[0] : nullptr};
        code_node(io, nodes.node[half], around, roots);
    }
}

bool within(const TimeNode& node, const TimeNodeSurroundings& surroundings) {
    for (const Ref root : node.root) {
        const auto level = static_cast<std::size_t>(time_level_of(root));
        if (level >= surroundings.root_nodes.size() ||
            index_of(root) >= surroundings.root_nodes[level]) {
            return false;
        }
    }
    const auto inside = [](std::int32_t low, std::int32_t high, std::int32_t size) {
        return low >= 0 && low <= size && high >= 0 && high <= size;
    };
    return inside(node.bounds.left, node.bounds.right, surroundings.shape.width()) &&
           inside(node.bounds.top, node.bounds.bottom, surroundings.shape.height());
}

}  // namespace

int sibling_count(const ClipShape& shape, const SiblingAddress& address) {
    if (address.time_level == 0) return 1;
    return shape.contains({address.time_level, 2 * address.index + 1}) ? 2 : 1;
}

std::vector<std::byte> encode_time_nodes(const SiblingNodes& nodes,
                                         const TimeNodeSurroundings& surroundings) {
    assert(nodes.count == sibling_count(surroundings.shape, surroundings.address));
    Put io;
    SiblingNodes copy = nodes;
    code_nodes(io, copy, surroundings);
    return io.finish();
}

Result<void> decode_time_nodes(std::span<const std::byte> chunk,
                               const TimeNodeSurroundings& surroundings,
                               SiblingNodes& nodes) {
    StreamReader streams(chunk);
    Result<TakeRefs> refs = TakeRefs::open(streams, 2 * kEdges);
    if (!refs) return std::move(refs).error();
    Result<Stream> bytes = streams.next(kMostBytes);
    if (!bytes) return std::move(bytes).error();
    nodes = {};
    nodes.count = sibling_count(surroundings.shape, surroundings.address);
    Take io(*std::move(refs), *std::move(bytes));
    code_nodes(io, nodes, surroundings);
    for (int half = 0; half < nodes.count; ++half) {
        if (io.refs.damaged() || !within(nodes.node[half], surroundings)) {
            return Error{ErrorCode::kUndecodable,
                         "roots or bounds of half " + std::to_string(half)};
        }
    }
    if (!io.at_end() || !streams.at_end()) {
        return Error{ErrorCode::kUndecodable, "streams left over or missing"};
    }
    return {};
}

}  // namespace haarmony::video
