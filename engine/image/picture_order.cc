#include "engine/image/picture_order.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <numeric>

#include "engine/image/bit_sums.h"
#include "engine/image/profile.h"
#include "engine/image/query.h"

namespace haarmony::image {
namespace {

constexpr int kCoarseSide = 4;
// Pictures of a node that its split is chosen by: enough for a density within 3 %.
constexpr std::size_t kSample = 512;

std::uint32_t key_of(int bit) {
    const int place = bit / 2 % (kCoarseSide * kCoarseSide - 1) + 1;
    const int channel = bit / 2 / (kCoarseSide * kCoarseSide - 1);
    const int index = place / kCoarseSide * kSide + place % kCoarseSide;
    return coefficient_key(channel, bit % 2 == 0 ? index : -index);
}

// What a sign weighs: queries come under several bin rules, and the order has to serve all.
double reference_weight(int bit) {
    const Profile scanned = *built_in_profile("scanned");
    const int index = static_cast<int>(key_of(bit) % kCoefficientCount);
    const int channel = bit / 2 / (kCoarseSide * kCoarseSide - 1);
    const auto weight = [&](BinRule rule) {
        return double(
            scanned.weights[channel][image::bin(rule, index / kSide, index % kSide)]);
    };
    // The literal rule gives the coarsest the weight of the average, many times that of
    // all others; a part of it keeps them first without forgetting the rest.
    return weight(BinRule::kLog2Plus1) + weight(BinRule::kLiteral) / 8.0;
}

class KdTree {
  public:
    KdTree(std::span<const PictureTerms> terms, std::span<const CoarseSigns> signs)
        : terms_(terms), signs_(signs), order_(signs.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        const Profile scanned = *built_in_profile("scanned");
        for (int c = 0; c < kChannels; ++c)
            average_weights_[c] = scanned.weights[c][0] / double{kAverageOne};
        for (int bit = 0; bit < CoarseSigns::kCount; ++bit)
            sign_weights_[bit] = reference_weight(bit);
    }

    std::vector<std::uint32_t> order() {
        split(order_);
        return std::move(order_);
    }

  private:
    using Pictures = std::span<std::uint32_t>;

    // Depth is bounded: a sign splits a path at most once, and an average halves it.
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
        std::size_t at = pictures.size() / 2;
        if (best_average >= 0) {
            std::ranges::nth_element(
                pictures, pictures.begin() + std::ptrdiff_t(at), {}, [&](auto picture) {
                    return terms_[picture].average[best_average];
                });
        } else if (best_sign >= 0) {
            const auto with = std::ranges::partition(
                pictures, [&](auto picture) { return !signs_[picture].test(best_sign); });
            at = pictures.size() - with.size();
        } else {
            return;  // all alike
        }
        split(pictures.first(at));
        split(pictures.subspan(at));
    }

    void sample(Pictures pictures) {
        sampled_.clear();
        const std::size_t count = std::min(pictures.size(), kSample);
        for (std::size_t i = 0; i < count; ++i)
            sampled_.push_back(pictures[i * pictures.size() / count]);
        counts_ = {};
        for (const std::uint32_t picture : sampled_) {
            int base = 0;
            for (std::uint64_t word : signs_[picture].words()) {
                for (; word != 0; word &= word - 1)
                    ++counts_[base + std::countr_zero(word)];
                base += 64;
            }
        }
    }

    // Mean distance from the median, of the sample.
    double deviation(int channel) {
        std::vector<std::int32_t>& values = values_;
        values.clear();
        for (const std::uint32_t picture : sampled_)
            values.push_back(terms_[picture].average[channel]);
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::ranges::nth_element(values, middle);
        double sum = 0;
        for (const std::int32_t value : values)
            sum += std::abs(double(value) - double(*middle));
        return sum / double(values.size());
    }

    std::span<const PictureTerms> terms_;
    std::span<const CoarseSigns> signs_;
    std::array<double, kChannels> average_weights_{};
    std::array<double, CoarseSigns::kCount> sign_weights_{};
    std::vector<std::uint32_t> order_;
    // Of the node in hand.
    std::vector<std::uint32_t> sampled_;
    std::vector<std::int32_t> values_;
    std::array<int, 128> counts_{};
};

}  // namespace

int CoarseSigns::bit_of(std::uint32_t key) {
    const int index = static_cast<int>(key % kCoefficientCount);
    const int row = index / kSide;
    const int column = index % kSide;
    if (row >= kCoarseSide || column >= kCoarseSide || index == 0) return -1;
    const int place = row * kCoarseSide + column - 1;
    const int channel_and_sign = static_cast<int>(key / kCoefficientCount);
    return (channel_and_sign / 2 * (kCoarseSide * kCoarseSide - 1) + place) * 2 +
           channel_and_sign % 2;
}

std::vector<std::uint32_t> picture_order(std::span<const PictureTerms> terms,
                                         std::span<const CoarseSigns> signs) {
    return KdTree(terms, signs).order();
}

}  // namespace haarmony::image
