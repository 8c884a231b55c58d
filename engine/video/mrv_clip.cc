#include "engine/video/mrv_clip.h"

#include <algorithm>
#include <atomic>
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
namespace {

// One of the time trees that the clip has been: its siblings depend on each other alone.
class Generation {
  public:
    // Keys begin with `first_key`: the ordinals of all generations count on. `decoded` counts
    // what is decoded.
    Generation(std::span<const std::byte> file,
               const ClipShape& shape,
               const MrvIndex& index,
               std::size_t first_key,
               DecodedCache& cache,
               DecodedCache::Owner owner,
               std::atomic<std::uint64_t>& decoded)
        : file_(file),
          shape_(shape),
          index_(index),
          first_key_(first_key),
          cache_(cache),
          owner_(owner),
          decoded_(decoded) {}

    [[nodiscard]] const ClipShape& shape() const { return shape_; }
    [[nodiscard]] std::optional<std::size_t> find(const SiblingAddress& address) const {
        return index_.find(address);
    }

    Result<Frame::Nodes> nodes(std::size_t ordinal) const {
        Result<DecodedCache::Value> value =
            cache_.get(key(0, ordinal), [&] { return decode_nodes(ordinal); });
        if (!value) return std::move(value).error();
        return std::static_pointer_cast<const SiblingNodes>(*std::move(value));
    }

    Result<Frame::LayerPtr> layer(std::size_t ordinal, int row) const {
        if (index_.chunk(row, ordinal).size.empty()) return empty_;
        Result<DecodedCache::Value> value =
            cache_.get(key(row, ordinal), [&] { return decode_layer_at(ordinal, row); });
        if (!value) return std::move(value).error();
        return std::static_pointer_cast<const Layer>(*std::move(value));
    }

    // Decodes the siblings and all below them, and says how much memory that took. What is
    // above is held by the callers, so that nothing is decoded twice, however small the cache.
    Result<std::uint64_t> decode(std::size_t ordinal) const {
        Result<Frame::Nodes> own_nodes = nodes(ordinal);
        if (!own_nodes) return std::move(own_nodes).error();
        std::uint64_t bytes =
            sizeof(TimeNode) * static_cast<std::uint64_t>((*own_nodes)->count);
        std::vector<Frame::LayerPtr> held;
        for (int row = 1; row < index_.rows(); ++row) {
            Result<Frame::LayerPtr> found = layer(ordinal, row);
            if (!found) return std::move(found).error();
            bytes += (*found)->memory_bytes();
            held.push_back(*std::move(found));
        }
        const SiblingAddress& address = index_.address(ordinal);
        for (int half = 0; half < (*own_nodes)->count; ++half) {
            const std::int64_t index =
                address.time_level == 0 ? 0 : 2 * address.index + half;
            const auto below = find({address.time_level + 1, index});
            if (!below) continue;
            const Result<std::uint64_t> decoded = decode(*below);
            if (!decoded) return decoded.error();
            bytes += *decoded;
        }
        return bytes;
    }

  private:
    [[nodiscard]] DecodedCache::Key key(int row, std::size_t ordinal) const {
        return {
            owner_,
            std::uint64_t{first_key_ + ordinal} << 8 | static_cast<std::uint64_t>(row)};
    }

    [[nodiscard]] std::vector<std::size_t> ordinals_to(std::size_t ordinal) const {
        const SiblingAddress& address = index_.address(ordinal);
        std::vector<std::size_t> ordinals;
        for (int k = 0; k <= address.time_level; ++k)
            ordinals.push_back(*find(ancestor_of(address, k)));
        return ordinals;
    }

    [[nodiscard]] Error in_chunk(std::size_t ordinal,
                                 int row,
                                 const std::string& what) const {
        const SiblingAddress& address = index_.address(ordinal);
        const std::string part =
            row == 0 ? "time nodes"
                     : "space level " + std::to_string(row + kBrickLevel - 1);
        return {ErrorCode::kUndecodable,
                ".mrv file: " + part + " of time level " +
                    std::to_string(address.time_level) + ", siblings " +
                    std::to_string(address.index) + ": " + what};
    }

    Result<std::span<const std::byte>> chunk_bytes(std::size_t ordinal, int row) const {
        const MrvChunk& chunk = index_.chunk(row, ordinal);
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

    Result<DecodedCache::Decoded> decode_nodes(std::size_t ordinal) const {
        const std::vector<std::size_t> chain = ordinals_to(ordinal);
        TimeNodeSurroundings around{.shape = shape_,
                                    .address = index_.address(ordinal),
                                    .time_parent = nullptr,
                                    .root_nodes = {}};
        for (const std::size_t i : chain)
            around.root_nodes.push_back(index_.chunk(1, i).size.nodes);
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
        ++decoded_;
        return DecodedCache::Decoded{std::move(decoded), sizeof(SiblingNodes)};
    }

    Result<DecodedCache::Decoded> decode_layer_at(std::size_t ordinal, int row) const {
        const auto bytes = chunk_bytes(ordinal, row);
        if (!bytes) return bytes.error();
        const std::vector<std::size_t> chain = ordinals_to(ordinal);
        LayerSurroundings around;
        around.address = index_.address(ordinal);
        around.space_level = row + kBrickLevel - 1;
        around.finest_level = index_.rows() + kBrickLevel - 2;
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
                around.finer_nodes.push_back(index_.chunk(row + 1, i).size.nodes);
        }
        around.layers.back().push_back(decoded.get());
        const LayerSize& size = index_.chunk(row, ordinal).size;
        if (Result<void> done = decode_layer(*bytes, size, around, *decoded); !done)
            return in_chunk(ordinal, row, done.error().message);
        decoded->compact();
        ++decoded_;
        return DecodedCache::Decoded{decoded, decoded->memory_bytes() + sizeof(Layer)};
    }

    std::span<const std::byte> file_;
    const ClipShape& shape_;
    const MrvIndex& index_;
    std::size_t first_key_;
    DecodedCache& cache_;
    DecodedCache::Owner owner_;
    std::atomic<std::uint64_t>& decoded_;
    Frame::LayerPtr empty_ = std::make_shared<const Layer>();
};

}  // namespace

class MrvClip::Impl {
  public:
    Impl(std::span<const std::byte> file,
         MrvFront front,
         std::shared_ptr<DecodedCache> cache)
        : front_(std::move(front)),
          cache_(std::move(cache)),
          owner_(cache_->add_owner()) {
        std::size_t key = 0;
        for (const MrvGeneration& older : front_.older) {
            add_generation(file, older.shape, older.index, key);
            key += older.index.siblings();
        }
        add_generation(file, front_.shape, front_.index, key);
    }
    ~Impl() { cache_->remove_owner(owner_); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // Siblings of the clip where they are stored: in a generation, at its time levels.
    struct Place {
        const Generation* generation;
        SiblingAddress address;
    };
    [[nodiscard]] Place place(const SiblingAddress& address) const {
        const int levels = front_.shape.time_levels();
        auto found = generations_.end() - 1;
        if (address.time_level > 0) {
            const std::int64_t end = (address.index + 1)
                                     << (levels - address.time_level + 1);
            found = std::partition_point(
                generations_.begin(), found, [end](const Generation& generation) {
                    return generation.shape().frames() < end;
                });
        }
        const int younger = levels - found->shape().time_levels();
        return {&*found, {address.time_level - younger, address.index}};
    }

    [[nodiscard]] const MrvFront& front() const { return front_; }
    [[nodiscard]] const DecodedCache& cache() const { return *cache_; }
    [[nodiscard]] std::uint64_t decoded() const { return decoded_; }

    [[nodiscard]] Result<std::uint64_t> decode() const {
        std::uint64_t bytes = 0;
        for (const Generation& generation : generations_) {
            const Result<std::uint64_t> decoded = generation.decode(0);
            if (!decoded) return decoded.error();
            bytes += *decoded;
        }
        return bytes;
    }

  private:
    void add_generation(std::span<const std::byte> file,
                        const ClipShape& shape,
                        const MrvIndex& index,
                        std::size_t first_key) {
        generations_.emplace_back(
            file, shape, index, first_key, *cache_, owner_, decoded_);
    }

    MrvFront front_;
    std::shared_ptr<DecodedCache> cache_;
    const DecodedCache::Owner owner_;
    std::atomic<std::uint64_t> decoded_ = 0;
    std::vector<Generation> generations_;  // the first first
};

MrvClip::MrvClip(std::unique_ptr<Impl> impl)
    : TimeTree(impl->front().shape, impl->front().delta), impl_(std::move(impl)) {}
MrvClip::~MrvClip() = default;

Result<std::unique_ptr<MrvClip>> MrvClip::open(std::span<const std::byte> file,
                                               std::size_t cache_bytes) {
    return open(file, std::make_shared<DecodedCache>(cache_bytes));
}

Result<std::unique_ptr<MrvClip>> MrvClip::open(std::span<const std::byte> file,
                                               std::shared_ptr<DecodedCache> cache) {
    Result<MrvFront> front = decode_front(file);
    if (!front) return std::move(front).error();
    return std::unique_ptr<MrvClip>(
        new MrvClip(std::make_unique<Impl>(file, *std::move(front), std::move(cache))));
}

bool MrvClip::stored(const SiblingAddress& address) const {
    const Impl::Place place = impl_->place(address);
    return place.generation->find(place.address).has_value();
}

int MrvClip::depth(const SiblingAddress& address) const {
    return impl_->place(address).address.time_level;
}

Result<Frame::Nodes> MrvClip::nodes(const SiblingAddress& address) const {
    return nodes_on_way(address, depth(address));
}

Result<Frame::LayerPtr> MrvClip::layer(const SiblingAddress& address,
                                       int space_level) const {
    return layer_on_way(address, depth(address), space_level);
}

Result<Frame::Nodes> MrvClip::nodes_on_way(const SiblingAddress& address,
                                           int time_level) const {
    const Impl::Place place = impl_->place(address);
    const auto found = place.generation->find(ancestor_of(place.address, time_level));
    assert(found);
    return place.generation->nodes(*found);
}

Result<Frame::LayerPtr> MrvClip::layer_on_way(const SiblingAddress& address,
                                              int time_level,
                                              int space_level) const {
    assert(space_level >= kBrickLevel &&
           mrv_row_of(space_level) < impl_->front().index.rows());
    const Impl::Place place = impl_->place(address);
    const auto found = place.generation->find(ancestor_of(place.address, time_level));
    assert(found);
    return place.generation->layer(*found, mrv_row_of(space_level));
}

const MrvFront& MrvClip::front() const { return impl_->front(); }
std::uint64_t MrvClip::revision() const { return impl_->front().revision; }
std::size_t MrvClip::cached_bytes() const { return impl_->cache().bytes(); }
std::uint64_t MrvClip::decoded_chunks() const { return impl_->decoded(); }
Result<std::uint64_t> MrvClip::memory_bytes() const { return impl_->decode(); }

Result<void> MrvClip::verify() const {
    const Result<std::uint64_t> decoded = impl_->decode();
    if (!decoded) return decoded.error();
    return {};
}

}  // namespace haarmony::video
