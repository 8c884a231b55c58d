#include "engine/video/mrv_clip.h"

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/video/decoded_cache.h"
#include "engine/video/layer_coder.h"
#include "engine/video/mrv_format.h"
#include "engine/video/time_node_coder.h"

namespace haarmony::video {

class MrvClip::Impl {
  public:
    Impl(std::span<const std::byte> file, MrvFront front, std::size_t cache_bytes)
        : file_(file), front_(std::move(front)), cache_(cache_bytes) {}

    [[nodiscard]] const MrvFront& front() const { return front_; }
    [[nodiscard]] const DecodedCache& cache() const { return cache_; }
    [[nodiscard]] std::optional<std::size_t> find(const SiblingAddress& address) const {
        return front_.index.find(address);
    }

    Result<Frame::Nodes> nodes(std::size_t ordinal) {
        Result<DecodedCache::Value> value =
            cache_.get(key(0, ordinal), [&] { return decode_nodes(ordinal); });
        if (!value) return std::move(value).error();
        return std::static_pointer_cast<const SiblingNodes>(*std::move(value));
    }

    Result<Frame::LayerPtr> layer(std::size_t ordinal, int row) {
        if (front_.index.chunk(row, ordinal).size.empty()) return empty_;
        Result<DecodedCache::Value> value =
            cache_.get(key(row, ordinal), [&] { return decode_layer_at(ordinal, row); });
        if (!value) return std::move(value).error();
        return std::static_pointer_cast<const Layer>(*std::move(value));
    }

    // Decodes the siblings and all below them. What is above is held by the callers, so that
    // nothing is decoded twice, however small the cache.
    Result<void> verify(std::size_t ordinal) {
        Result<Frame::Nodes> own_nodes = nodes(ordinal);
        if (!own_nodes) return std::move(own_nodes).error();
        std::vector<Frame::LayerPtr> held;
        for (int row = 1; row < front_.index.rows(); ++row) {
            Result<Frame::LayerPtr> found = layer(ordinal, row);
            if (!found) return std::move(found).error();
            held.push_back(*std::move(found));
        }
        const SiblingAddress& address = front_.index.address(ordinal);
        for (int half = 0; half < (*own_nodes)->count; ++half) {
            const std::int64_t index =
                address.time_level == 0 ? 0 : 2 * address.index + half;
            const auto below = find({address.time_level + 1, index});
            if (!below) continue;
            if (Result<void> checked = verify(*below); !checked) return checked;
        }
        return {};
    }

  private:
    static std::uint64_t key(int row, std::size_t ordinal) {
        return static_cast<std::uint64_t>(ordinal) << 8 | static_cast<std::uint64_t>(row);
    }

    [[nodiscard]] std::vector<std::size_t> ordinals_to(std::size_t ordinal) const {
        SiblingAddress address = front_.index.address(ordinal);
        std::vector<std::size_t> ordinals(static_cast<std::size_t>(address.time_level) +
                                          1);
        for (;;) {
            ordinals[static_cast<std::size_t>(address.time_level)] = ordinal;
            if (address.time_level == 0) return ordinals;
            address = siblings_of({address.time_level - 1, address.index});
            ordinal = *find(address);
        }
    }

    [[nodiscard]] Error in_chunk(std::size_t ordinal,
                                 int row,
                                 const std::string& what) const {
        const SiblingAddress& address = front_.index.address(ordinal);
        const std::string part =
            row == 0 ? "time nodes"
                     : "space level " + std::to_string(row + kBrickLevel - 1);
        return {ErrorCode::kUndecodable,
                ".mrv file: " + part + " of time level " +
                    std::to_string(address.time_level) + ", siblings " +
                    std::to_string(address.index) + ": " + what};
    }

    Result<std::span<const std::byte>> chunk_bytes(std::size_t ordinal, int row) const {
        const MrvChunk& chunk = front_.index.chunk(row, ordinal);
        if (chunk.offset > file_.size() || chunk.bytes > file_.size() - chunk.offset) {
            return in_chunk(
                ordinal,
                row,
                "the file ends at byte " + std::to_string(file_.size()) + ", before it");
        }
        const auto bytes = file_.subspan(chunk.offset, chunk.bytes);
        if (mrv_checksum(bytes) != chunk.checksum)
            return in_chunk(ordinal, row, "checksum");
        return bytes;
    }

    // The time node that the siblings halve. Requires: time level >= 1.
    static const TimeNode& halved(const SiblingAddress& address,
                                  const SiblingNodes& above) {
        return above.node[address.time_level == 1 ? 0 : address.index & 1];
    }

    Result<DecodedCache::Decoded> decode_nodes(std::size_t ordinal) {
        const std::vector<std::size_t> chain = ordinals_to(ordinal);
        TimeNodeSurroundings around{.shape = front_.shape,
                                    .address = front_.index.address(ordinal),
                                    .time_parent = nullptr,
                                    .root_nodes = {}};
        for (const std::size_t i : chain)
            around.root_nodes.push_back(front_.index.chunk(1, i).size.nodes);
        Frame::Nodes above;
        if (chain.size() > 1) {
            Result<Frame::Nodes> found = nodes(chain[chain.size() - 2]);
            if (!found) return std::move(found).error();
            above = *std::move(found);
            around.time_parent = &halved(around.address, *above);
        }
        const auto bytes = chunk_bytes(ordinal, 0);
        if (!bytes) return bytes.error();
        auto decoded = std::make_shared<SiblingNodes>();
        if (Result<void> done = decode_time_nodes(*bytes, around, *decoded); !done)
            return in_chunk(ordinal, 0, done.error().message);
        return DecodedCache::Decoded{std::move(decoded), sizeof(SiblingNodes)};
    }

    Result<DecodedCache::Decoded> decode_layer_at(std::size_t ordinal, int row) {
        const auto bytes = chunk_bytes(ordinal, row);
        if (!bytes) return bytes.error();
        const std::vector<std::size_t> chain = ordinals_to(ordinal);
        LayerSurroundings around;
        around.address = front_.index.address(ordinal);
        around.space_level = row + kBrickLevel - 1;
        around.finest_level = front_.index.rows() + kBrickLevel - 2;
        Result<Frame::Nodes> own_nodes = nodes(ordinal);
        if (!own_nodes) return std::move(own_nodes).error();
        around.nodes = (*own_nodes).get();
        Frame::Nodes above;
        if (chain.size() > 1) {
            Result<Frame::Nodes> found = nodes(chain[chain.size() - 2]);
            if (!found) return std::move(found).error();
            above = *std::move(found);
            around.time_parent = &halved(around.address, *above);
        }
        std::vector<Frame::LayerPtr> held;
        const auto decoded = std::make_shared<Layer>();
        for (const std::size_t i : chain) {
            std::vector<const Layer*>& layers = around.layers.emplace_back();
            for (int r = 1; r <= row; ++r) {
                if (i == ordinal && r == row) break;
                Result<Frame::LayerPtr> found = layer(i, r);
                if (!found) return std::move(found).error();
                layers.push_back((*found).get());
                held.push_back(*std::move(found));
            }
            if (around.space_level < around.finest_level)
                around.finer_nodes.push_back(front_.index.chunk(row + 1, i).size.nodes);
        }
        around.layers.back().push_back(decoded.get());
        const LayerSize& size = front_.index.chunk(row, ordinal).size;
        if (Result<void> done = decode_layer(*bytes, size, around, *decoded); !done)
            return in_chunk(ordinal, row, done.error().message);
        decoded->compact();
        return DecodedCache::Decoded{decoded, decoded->memory_bytes() + sizeof(Layer)};
    }

    std::span<const std::byte> file_;
    MrvFront front_;
    DecodedCache cache_;
    Frame::LayerPtr empty_ = std::make_shared<const Layer>();
};

MrvClip::MrvClip(std::unique_ptr<Impl> impl)
    : TimeTree(impl->front().shape, impl->front().delta), impl_(std::move(impl)) {}
MrvClip::~MrvClip() = default;

Result<std::unique_ptr<MrvClip>> MrvClip::open(std::span<const std::byte> file,
                                               std::size_t cache_bytes) {
    Result<MrvFront> front = decode_front(file);
    if (!front) return std::move(front).error();
    return std::unique_ptr<MrvClip>(
        new MrvClip(std::make_unique<Impl>(file, *std::move(front), cache_bytes)));
}

bool MrvClip::stored(const SiblingAddress& address) const {
    return impl_->find(address).has_value();
}

Result<Frame::Nodes> MrvClip::nodes(const SiblingAddress& address) const {
    assert(stored(address));
    return impl_->nodes(*impl_->find(address));
}

Result<Frame::LayerPtr> MrvClip::layer(const SiblingAddress& address,
                                       int space_level) const {
    assert(stored(address) && space_level >= kBrickLevel &&
           mrv_row_of(space_level) < impl_->front().index.rows());
    return impl_->layer(*impl_->find(address), mrv_row_of(space_level));
}

std::uint64_t MrvClip::revision() const { return impl_->front().revision; }
std::size_t MrvClip::cached_bytes() const { return impl_->cache().bytes(); }
std::uint64_t MrvClip::decoded_chunks() const { return impl_->cache().decoded(); }
Result<void> MrvClip::verify() const { return impl_->verify(0); }

}  // namespace haarmony::video
