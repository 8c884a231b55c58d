#include "engine/image/segment_pictures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

namespace haarmony::image {
namespace {

// Blocks that are read together: of each row two cache lines, and of a thousand pictures
// what fits into a second-level cache.
constexpr int kBlocksTogether = 4;
constexpr std::size_t kSlotsTogether = std::size_t{kBlocksTogether} * kBlockSlots;

// Coefficients of some pictures, each at its rank.
class Gathered {
  public:
    // There is one line more, for what is not wanted: to write it there is cheaper than to
    // ask at every bit.
    Gathered(std::size_t pictures, std::size_t index_m)
        : index_m_(index_m), indices_((pictures + 1) * kChannels * index_m) {}

    [[nodiscard]] std::size_t unwanted() const {
        return indices_.size() / (kChannels * index_m_) - 1;
    }
    // No coefficient has index 0.
    void clear() { std::ranges::fill(indices_, std::int16_t{0}); }
    void put(std::size_t line, int channel, std::size_t rank, std::int16_t signed_index) {
        indices_[begin(line, channel) + rank] = signed_index;
    }
    [[nodiscard]] PictureCoefficients coefficients(std::size_t line) const {
        PictureCoefficients coefficients;
        for (int c = 0; c < kChannels; ++c) {
            const auto all = std::span(indices_).subspan(begin(line, c), index_m_);
            std::size_t count = index_m_;
            while (count > 0 && all[count - 1] == 0) --count;
            coefficients[c] = all.first(count);
        }
        return coefficients;
    }

  private:
    [[nodiscard]] std::size_t begin(std::size_t line, int channel) const {
        return (line * kChannels + std::size_t(channel)) * index_m_;
    }

    std::size_t index_m_;
    std::vector<std::int16_t> indices_;
};

// Some neighbouring blocks of a segment, and where their pictures go.
class Blocks {
  public:
    Blocks(const SegmentView& view, int first)
        : view_(view),
          first_(first),
          count_(std::min(kBlocksTogether, view.counts.blocks() - first)) {}

    [[nodiscard]] std::size_t first_slot() const {
        return std::size_t(first_) * kBlockSlots;
    }
    [[nodiscard]] std::size_t end_slot() const {
        return std::min(first_slot() + std::size_t(count_) * kBlockSlots,
                        std::size_t{view_.counts.slots});
    }

    void want(std::size_t slot, std::size_t line) {
        lines_[slot - first_slot()] = static_cast<std::uint32_t>(line);
        wanted_[(slot - first_slot()) / kBlockSlots] = true;
    }

    // Puts what is wanted into the lines; all others have been told where they are not.
    void gather(Gathered& gathered) const {
        if (std::ranges::find(wanted_, true) == wanted_.end()) return;
        gather_dense(gathered);
        gather_own(gathered);
    }
    void want_none(std::size_t unwanted) {
        lines_.fill(static_cast<std::uint32_t>(unwanted));
        unwanted_ = unwanted;
    }

  private:
    void gather_dense(Gathered& gathered) const {
        const std::size_t stride = view_.counts.row_words();
        const auto blocks = static_cast<std::size_t>(view_.counts.blocks());
        const auto rows = view_.rows[std::size_t(view_.tiers.top())];
        for (std::size_t list = 0; list < view_.dense_keys.size(); ++list) {
            const std::uint32_t key = view_.dense_keys[list];
            const auto channel = static_cast<int>(key / (2 * kCoefficientCount));
            const auto index = static_cast<std::int16_t>(key % kCoefficientCount);
            const bool negative = key / kCoefficientCount % 2 != 0;
            const auto signed_index =
                static_cast<std::int16_t>(negative ? -index : index);
            for (int b = 0; b < count_; ++b) {
                if (!wanted_[b]) continue;
                const auto block = static_cast<std::size_t>(first_ + b);
                std::size_t rank = view_.dense_rank_begin[list * blocks + block];
                for (std::size_t word = 0; word < kBlockWords; ++word) {
                    const std::uint32_t* const lines =
                        lines_.data() + (std::size_t(b) * kBlockWords + word) * 64;
                    for (std::uint64_t bits =
                             rows[list * stride + block * kBlockWords + word];
                         bits != 0;
                         bits &= bits - 1) {
                        gathered.put(lines[std::countr_zero(bits)],
                                     channel,
                                     view_.dense_ranks[rank++],
                                     signed_index);
                    }
                }
            }
        }
    }

    // Those of lists that are dense in a tier above were among the dense ones: they are put
    // where they are already.
    void gather_own(Gathered& gathered) const {
        const auto top = static_cast<std::size_t>(view_.tiers.top());
        for (std::size_t slot = first_slot(); slot < end_slot(); ++slot) {
            const std::uint32_t line = lines_[slot - first_slot()];
            if (line == unwanted_) continue;
            std::size_t at = view_.own_begin[slot];
            for (int c = 0; c < kChannels; ++c) {
                for (const std::size_t end = at + view_.own_counts[slot][c][top];
                     at < end;
                     ++at)
                    gathered.put(line, c, view_.own_ranks[at], view_.own[at]);
            }
        }
    }

    const SegmentView& view_;
    int first_;
    int count_;
    std::size_t unwanted_ = 0;
    std::array<bool, kBlocksTogether> wanted_{};
    std::array<std::uint32_t, kSlotsTogether> lines_{};
};

}  // namespace

SegmentPictures::SegmentPictures(std::vector<Part> parts, std::size_t pictures)
    : parts_(std::move(parts)),
      pictures_(pictures),
      index_m_(parts_.empty() ? 0 : parts_[0].view.counts.index_m) {
    for ([[maybe_unused]] const Part& part : parts_) {
        assert(part.view.counts.index_m == index_m_);
        assert(part.place_of.size() == part.view.counts.slots);
    }
}

void SegmentPictures::give_all(const PictureSink& sink) const {
    Gathered gathered(kSlotsTogether, index_m_);
    for (const Part& part : parts_) {
        for (int first = 0; first < part.view.counts.blocks(); first += kBlocksTogether) {
            Blocks blocks(part.view, first);
            blocks.want_none(gathered.unwanted());
            for (std::size_t slot = blocks.first_slot(); slot < blocks.end_slot();
                 ++slot) {
                if (part.place_of[slot] != kLeftOut)
                    blocks.want(slot, slot - blocks.first_slot());
            }
            gathered.clear();
            blocks.gather(gathered);
            for (std::size_t slot = blocks.first_slot(); slot < blocks.end_slot();
                 ++slot) {
                if (part.place_of[slot] != kLeftOut)
                    sink(static_cast<std::uint32_t>(part.place_of[slot]),
                         gathered.coefficients(slot - blocks.first_slot()));
            }
        }
    }
}

void SegmentPictures::give(std::span<const std::uint32_t> places,
                           const PictureSink& sink) const {
    Gathered gathered(std::min(kGathered, places.size()), index_m_);
    const auto unwanted = static_cast<std::uint32_t>(gathered.unwanted());
    std::vector<std::uint32_t> line_of(pictures_, unwanted);  // [place]
    for (; !places.empty(); places = places.subspan(std::min(kGathered, places.size()))) {
        const auto some = places.first(std::min(kGathered, places.size()));
        for (std::uint32_t line = 0; line < some.size(); ++line)
            line_of[some[line]] = line;
        gathered.clear();
        for (const Part& part : parts_) {
            for (int first = 0; first < part.view.counts.blocks();
                 first += kBlocksTogether) {
                Blocks blocks(part.view, first);
                blocks.want_none(unwanted);
                for (std::size_t slot = blocks.first_slot(); slot < blocks.end_slot();
                     ++slot) {
                    const std::int32_t place = part.place_of[slot];
                    if (place != kLeftOut && line_of[std::size_t(place)] != unwanted)
                        blocks.want(slot, line_of[std::size_t(place)]);
                }
                blocks.gather(gathered);
            }
        }
        for (std::uint32_t line = 0; line < some.size(); ++line) {
            sink(some[line], gathered.coefficients(line));
            line_of[some[line]] = unwanted;
        }
    }
}

}  // namespace haarmony::image
