#include "engine/image/picture_order.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/image/bit_sums.h"
#include "engine/image/profile.h"
#include "engine/image/query.h"

namespace haarmony::image {
namespace {

constexpr int kCoarseSide = 4;
constexpr int kCoarsePlaces = kCoarseSide * kCoarseSide - 1;  // all but the mean
static_assert(CoarseSigns::kCount == 2 * kChannels * kCoarsePlaces);
// Pictures of a node that its split is chosen by: a density found in as many is within 2.2 %
// of the true one (a standard deviation).
constexpr std::size_t kSample = 512;

// What a sign weighs, in the weights' unit: queries come under several bin rules, and the
// order has to serve all.
double reference_weight(const Profile& profile, int bit) {
    const int place = bit / 2 % kCoarsePlaces + 1;
    const int channel = bit / 2 / kCoarsePlaces;
    const auto weight = [&](BinRule rule) {
        return profile
            .weights[channel][bin(rule, place / kCoarseSide, place % kCoarseSide)];
    };
    // The literal rule gives the coarsest the weight of the average, many times that of
    // all others; a part of it keeps them first without forgetting the rest.
    return weight(BinRule::kLog2Plus1) + weight(BinRule::kLiteral) / 8.0;
}

// A picture and all that its place depends on, in one piece: below the first splits the
// pictures of a node stand anywhere in memory.
struct Picture {
    CoarseSigns signs;
    std::array<std::int32_t, kChannels> average{};
    std::uint32_t place = 0;
};

class KdTree {
  public:
    KdTree(std::span<const PictureTerms> terms, std::span<const CoarseSigns> signs) {
        order_.reserve(signs.size());
        for (std::uint32_t place = 0; place < signs.size(); ++place)
            order_.push_back({signs[place], terms[place].average, place});
        const Profile scanned = *built_in_profile("scanned");
        for (int c = 0; c < kChannels; ++c)
            average_weights_[c] = scanned.weights[c][0] / double{kAverageOne};
        for (int bit = 0; bit < CoarseSigns::kCount; ++bit)
            sign_weights_[bit] = reference_weight(scanned, bit);
    }

    std::vector<std::uint32_t> order() {
        split(order_);
        std::vector<std::uint32_t> places;
        places.reserve(order_.size());
        for (const Picture& picture : order_) places.push_back(picture.place);
        return places;
    }

  private:
    using Pictures = std::span<Picture>;

    // Depth is bounded: a sign splits a path at most once, and an average halves it, but for
    // half a block.
    void split(Pictures pictures) {
        if (pictures.size() <= std::size_t{kBlockSlots}) return;
        sample(pictures);
        double best_gain = 0;
        int best_sign = -1;
        for (int bit = 0; bit < CoarseSigns::kCount; ++bit) {
            const double density = double(counts_[bit]) / double(sampled_.size());
            const double gain = sign_weights_[bit] * density * (1 - density);
            if (gain > best_gain) {
                best_gain = gain;
                best_sign = bit;
            }
        }
        int best_average = -1;
        for (int c = 0; c < kChannels; ++c) {
            const double gain = average_weights_[c] * deviation(c) / 2;
            if (gain > best_gain) {
                best_gain = gain;
                best_average = c;
            }
        }
        std::size_t at = 0;
        if (best_average >= 0) {
            at = block_end_near_middle(pictures);
            std::ranges::nth_element(
                pictures,
                pictures.begin() + std::ptrdiff_t(at),
                {},
                [&](const Picture& picture) { return picture.average[best_average]; });
        } else if (best_sign >= 0) {
            const auto with = std::partition(
                pictures.begin(), pictures.end(), [&](const Picture& picture) {
                    return !picture.signs.test(best_sign);
                });
            at = std::size_t(with - pictures.begin());
        } else {
            return;  // all alike, as far as the sample shows
        }
        split(pictures.first(at));
        split(pictures.subspan(at));
    }

    // Nearest to the middle of the node, within it: a node has more than a block. Halves that
    // meet within a block would make one of pictures from both.
    std::size_t block_end_near_middle(Pictures pictures) const {
        const auto begin = static_cast<std::size_t>(pictures.data() - order_.data());
        const std::size_t middle = begin + pictures.size() / 2;
        return (middle + kBlockSlots / 2) / kBlockSlots * kBlockSlots - begin;
    }

    // Which pictures of a node speak for it, and how many of them have each sign.
    void sample(Pictures pictures) {
        sampled_.clear();
        const std::size_t count = std::min(pictures.size(), kSample);
        for (std::size_t i = 0; i < count; ++i)
            sampled_.push_back(&pictures[i * pictures.size() / count]);
        counts_ = {};
        for (const Picture* const picture : sampled_) {
            int base = 0;
            for (std::uint64_t word : picture->signs.words()) {
                for (; word != 0; word &= word - 1)
                    ++counts_[base + std::countr_zero(word)];
                base += 64;
            }
        }
    }

    // Mean distance from the median, of the sample.
    double deviation(int channel) {
        values_.clear();
        for (const Picture* const picture : sampled_)
            values_.push_back(picture->average[channel]);
        const auto middle = values_.begin() + std::ptrdiff_t(values_.size() / 2);
        std::ranges::nth_element(values_, middle);
        const double median = *middle;
        double sum = 0;
        for (const std::int32_t value : values_) sum += std::abs(value - median);
        return sum / double(values_.size());
    }

    std::array<double, kChannels> average_weights_{};
    std::array<double, CoarseSigns::kCount> sign_weights_{};
    std::vector<Picture> order_;
    // Of the node in hand, before it is split.
    std::vector<const Picture*> sampled_;
    std::vector<std::int32_t> values_;
    std::array<int, 128> counts_{};  // one for each bit of CoarseSigns::words()
};

}  // namespace

int CoarseSigns::bit_of(std::uint32_t key) {
    assert(key < kKeyCount);
    const int index = static_cast<int>(key % kCoefficientCount);
    const int row = index / kSide;
    const int column = index % kSide;
    if (row >= kCoarseSide || column >= kCoarseSide || index == 0) return -1;
    const int place = row * kCoarseSide + column - 1;
    const int channel_and_sign = static_cast<int>(key / kCoefficientCount);
    return (channel_and_sign / 2 * kCoarsePlaces + place) * 2 + channel_and_sign % 2;
}

std::vector<std::uint32_t> picture_order(std::span<const PictureTerms> terms,
                                         std::span<const CoarseSigns> signs) {
    assert(terms.size() == signs.size());
    return KdTree(terms, signs).order();
}

}  // namespace haarmony::image
