#include "engine/video/mrv_writer.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "engine/video/layer_coder.h"
#include "engine/video/mrv_format.h"
#include "engine/video/time_node_coder.h"

namespace haarmony::video {

class MrvWriter::Impl {
  public:
    Impl(Spool& waiting, Spool& file) : waiting_(waiting), file_(&file) {}
    Impl(const MrvFront& front, Spool& waiting, GrowingFile& growing)
        : waiting_(waiting), growing_(&growing), older_(front.older) {
        older_.push_back({.shape = front.shape,
                          .index = front.index,
                          .index_bytes = front.index_bytes,
                          .index_checksum = front.index_checksum,
                          .end = front.file_bytes});
    }

    Result<void> begin(const ClipShape& shape, std::uint32_t delta) {
        assert(older_.empty() ||
               (delta == 0 && older_.back().shape.format() == shape.format() &&
                older_.back().shape.frames() < shape.frames()));
        if (older_.size() == kMostGenerations) {
            return Error{ErrorCode::kConflict,
                         "frames were appended to the clip " +
                             std::to_string(kMostGenerations - 1) +
                             " times, which is the most; build it anew from itself"};
        }
        front_.emplace(MrvFront{.shape = shape,
                                .delta = delta,
                                .index = {},
                                .file_bytes = 0,
                                .revision = 0,
                                .index_bytes = 0,
                                .index_checksum = 0,
                                .older = older_});
        chain_.clear();
        written_.clear();
        return {};
    }

    Result<void> add(Siblings siblings) {
        assert(front_);
        const auto level = static_cast<std::size_t>(siblings.address.time_level);
        const SiblingAddress address = siblings.address;
        const auto rows = static_cast<std::size_t>(mrv_rows(front_->shape));
        assert(siblings.layers.size() + 1 == rows);
        assert(level <= chain_.size());
        chain_.resize(level);
        chain_.push_back(std::move(siblings));
        assert(level == 0 || chain_[level - 1].address ==
                                 siblings_of({address.time_level - 1, address.index}));

        std::vector<MrvChunk>& chunks = written_[{address.time_level, address.index}];
        if (Result<void> put = put_chunk(time_nodes(), {}, chunks.emplace_back()); !put)
            return put;
        for (std::size_t row = 1; row < rows; ++row) {
            const Layer& layer = chain_.back().layers[row - 1];
            if (layer.nodes.size() > kMaxRefIndex || layer.bricks.size() > kMaxRefIndex)
                return too_large(address, layer.nodes.size(), "nodes or bricks");
            const LayerSize size{static_cast<std::uint32_t>(layer.nodes.size()),
                                 static_cast<std::uint32_t>(layer.bricks.size())};
            MrvChunk& chunk = chunks.emplace_back();
            if (size.empty()) continue;
            if (Result<void> put =
                    put_chunk(encode_layer(surroundings(row)), size, chunk);
                !put) {
                return put;
            }
        }
        return {};
    }

    Result<void> finish() {
        assert(front_ && !written_.empty());
        std::vector<SiblingAddress> addresses;
        for (const auto& [address, chunks] : written_)
            addresses.push_back({address.first, address.second});
        MrvIndex index(std::move(addresses), mrv_rows(front_->shape));
        std::size_t ordinal = 0;
        for (const auto& [address, chunks] : written_) {
            for (int row = 0; row < index.rows(); ++row)
                index.chunk(row, ordinal) = chunks[static_cast<std::size_t>(row)];
            ++ordinal;
        }
        front_->index = std::move(index);
        chain_.clear();
        return growing_ == nullptr ? write_file() : write_generation();
    }

    [[nodiscard]] const MrvFront& front() const { return *front_; }

  private:
    Result<void> write_file() {
        if (auto put = file_->append(encode_front(*front_)); !put)
            return std::move(put).error();
        return each_chunk([this](std::span<const std::byte> bytes) -> Result<void> {
            if (auto put = file_->append(bytes); !put) return std::move(put).error();
            return {};
        });
    }

    Result<void> write_generation() {
        const MrvGenerationBytes made = encode_generation(*front_);
        std::uint64_t at = made.segment_at;
        const auto put = [&](std::span<const std::byte> bytes) {
            const std::uint64_t begin = at;
            at += bytes.size();
            return growing_->write(begin, bytes);
        };
        Result<void> written = put(made.segment);
        if (written) written = each_chunk(put);
        if (written) written = growing_->sync();
        if (written) written = growing_->write(made.slot_at, made.slot);
        if (written) written = growing_->sync();
        return written;
    }

    // In the order of the file.
    template <typename Put>
    Result<void> each_chunk(const Put& put) {
        const MrvIndex& index = front_->index;
        std::vector<std::byte> bytes;
        std::vector<const std::vector<MrvChunk>*> waiting;
        for (const auto& [address, chunks] : written_) waiting.push_back(&chunks);
        for (std::size_t row = 0; row < static_cast<std::size_t>(index.rows()); ++row) {
            for (const std::vector<MrvChunk>* chunks : waiting) {
                const MrvChunk& chunk = (*chunks)[row];
                if (chunk.bytes == 0) continue;
                bytes.resize(chunk.bytes);
                if (Result<void> got = waiting_.read(chunk.offset, bytes); !got)
                    return got;
                if (Result<void> done = put(bytes); !done) return done;
            }
        }
        return {};
    }

    static Error too_large(const SiblingAddress& address,
                           std::size_t count,
                           const char* what) {
        return {ErrorCode::kTooLarge,
                std::to_string(count) + " " + what + " in siblings " +
                    std::to_string(address.index) + " of time level " +
                    std::to_string(address.time_level)};
    }

    [[nodiscard]] const TimeNode* time_parent() const {
        if (chain_.size() < 2) return nullptr;
        const Siblings& above = chain_[chain_.size() - 2];
        return &above.nodes.node[above.address.time_level == 0
                                     ? 0
                                     : chain_.back().address.index & 1];
    }

    std::vector<std::byte> time_nodes() {
        TimeNodeSurroundings around{.shape = front_->shape,
                                    .address = chain_.back().address,
                                    .time_parent = time_parent(),
                                    .root_nodes = {}};
        return encode_time_nodes(chain_.back().nodes, around);
    }

    [[nodiscard]] LayerSurroundings surroundings(std::size_t row) const {
        LayerSurroundings made;
        made.address = chain_.back().address;
        made.space_level = static_cast<int>(row) - 1 + kBrickLevel;
        made.finest_level = mrv_rows(front_->shape) - 2 + kBrickLevel;
        made.nodes = &chain_.back().nodes;
        made.time_parent = time_parent();
        for (const Siblings& siblings : chain_) {
            std::vector<const Layer*>& layers = made.layers.emplace_back();
            for (std::size_t r = 1; r <= row; ++r)
                layers.push_back(&siblings.layers[r - 1]);
        }
        return made;
    }

    Result<void> put_chunk(const std::vector<std::byte>& bytes,
                           const LayerSize& size,
                           MrvChunk& chunk) {
        if (bytes.size() > UINT32_MAX)
            return too_large(chain_.back().address, bytes.size(), "bytes of a chunk");
        const Result<std::uint64_t> offset = waiting_.append(bytes);
        if (!offset) return offset.error();
        chunk = {.offset = *offset,
                 .bytes = static_cast<std::uint32_t>(bytes.size()),
                 .size = size,
                 .checksum = mrv_checksum(bytes)};
        return {};
    }

    Spool& waiting_;
    Spool* file_ = nullptr;           // of a new clip,
    GrowingFile* growing_ = nullptr;  // or of one that grows
    std::vector<MrvGeneration> older_;
    std::optional<MrvFront> front_;
    std::vector<Siblings> chain_;  // from the root of the time tree to the last added
    std::map<std::pair<int, std::int64_t>, std::vector<MrvChunk>> written_;
};

MrvWriter::MrvWriter(Spool& waiting, Spool& file)
    : impl_(std::make_unique<Impl>(waiting, file)) {}
MrvWriter::MrvWriter(const MrvFront& front, Spool& waiting, GrowingFile& file)
    : impl_(std::make_unique<Impl>(front, waiting, file)) {}
MrvWriter::~MrvWriter() = default;

Result<void> MrvWriter::begin(const ClipShape& shape, std::uint32_t delta) {
    return impl_->begin(shape, delta);
}
Result<void> MrvWriter::add(Siblings siblings) { return impl_->add(std::move(siblings)); }
Result<void> MrvWriter::finish() { return impl_->finish(); }
std::uint64_t MrvWriter::file_bytes() const { return impl_->front().file_bytes; }
std::uint64_t MrvWriter::revision() const { return impl_->front().revision; }

}  // namespace haarmony::video
