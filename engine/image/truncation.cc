#include "engine/image/truncation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

namespace haarmony::image {
namespace {

// Bits of |value|: as integers they are ordered as the magnitudes are.
std::uint32_t magnitude(float value) {
    return std::bit_cast<std::uint32_t>(value) & 0x7FFFFFFFU;
}

// One number per candidate, larger is better: magnitude first, then the smaller index.
std::uint64_t rank_key(float value, int index) {
    return std::uint64_t{magnitude(value)} << 32 |
           static_cast<std::uint32_t>(kCoefficientCount - index);
}

int index_of(std::uint64_t key) {
    return kCoefficientCount - static_cast<int>(static_cast<std::uint32_t>(key));
}

// Collects candidates above a running threshold, and raises it to the kMaxCoefficients-th
// best whenever the buffer is full. Coarse coefficients come first and are the large ones,
// so that few of the 16,383 are ever collected.
class Largest {
  public:
    [[nodiscard]] float threshold() const { return threshold_; }

    void add(float value, int index) {
        keys_[count_++] = rank_key(value, index);
        if (count_ == kCapacity) shrink();
    }

    [[nodiscard]] std::span<const std::uint64_t> sorted() {
        if (count_ > kMaxCoefficients) shrink();
        std::sort(keys_.begin(), keys_.begin() + count_, std::greater<>());
        return {keys_.data(), std::size_t(count_)};
    }

  private:
    static constexpr int kCapacity = 4 * kMaxCoefficients;

    void shrink() {
        const auto last = keys_.begin() + (kMaxCoefficients - 1);
        std::nth_element(keys_.begin(), last, keys_.begin() + count_, std::greater<>());
        threshold_ = std::bit_cast<float>(static_cast<std::uint32_t>(*last >> 32));
        count_ = kMaxCoefficients;
    }

    std::array<std::uint64_t, kCapacity> keys_;
    int count_ = 0;
    float threshold_ = 0.0F;
};

}  // namespace

ChannelSignature truncate(const Plane& coefficients) {
    constexpr int kBlock = 16;
    Largest largest;
    for (int begin = 0; begin < kCoefficientCount; begin += kBlock) {
        // An equal magnitude later on has the larger index and loses: strictly above.
        const float threshold = largest.threshold();
        int above = 0;
        for (int i = begin; i < begin + kBlock; ++i) {
            above |= static_cast<int>(std::fabs(coefficients[i]) > threshold);
        }
        if (above == 0) continue;
        for (int i = std::max(begin, 1); i < begin + kBlock; ++i) {
            if (std::fabs(coefficients[i]) > largest.threshold()) {
                largest.add(coefficients[i], i);
            }
        }
    }

    ChannelSignature channel;
    channel.average =
        static_cast<std::int32_t>(std::lround(double{coefficients[0]} * kAverageOne));
    for (const std::uint64_t key : largest.sorted()) {
        const int index = index_of(key);
        channel.indices[channel.count++] =
            static_cast<std::int16_t>(coefficients[index] > 0 ? index : -index);
    }
    return channel;
}

double wavelet_energy(const Plane& coefficients) {
    // Fixed partial sums, so that the result does not depend on the vector unit.
    constexpr int kLanes = 8;
    double energy = 0.0;
    for (int row = 0; row < kSide; ++row) {
        std::array<float, kLanes> lanes{};
        for (int begin = row * kSide; begin < (row + 1) * kSide; begin += kLanes) {
            for (int lane = 0; lane < kLanes; ++lane) {
                const int i = begin + lane;
                const float value = i == 0 ? 0.0F : coefficients[i];
                lanes[lane] += value * value;
            }
        }
        for (const float lane : lanes) energy += double{lane};
    }
    return energy;
}

}  // namespace haarmony::image
