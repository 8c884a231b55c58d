#include "engine/image/truncation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/image/haar_kernel.h"

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
// best whenever the buffer is full.
class Largest {
  public:
    explicit Largest(float threshold) : threshold_(threshold) {}

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
    float threshold_;
};

// Just below the kMaxCoefficients-th largest magnitude of the coarse coefficients, which is
// never above that of all: what does not exceed it is not among the largest. Of photographs it
// leaves a few hundred of the 16,383. Zero where there are not so many.
float coarse_threshold(const Plane& coefficients) {
    constexpr int kCoarse = 24;
    std::array<std::uint32_t, kCoarse * kCoarse> magnitudes;
    for (int i = 0; i < kCoarse; ++i) {
        for (int j = 0; j < kCoarse; ++j) {
            magnitudes[i * kCoarse + j] = magnitude(coefficients[i * kSide + j]);
        }
    }
    magnitudes[0] = 0;  // the mean is no candidate
    const auto last = magnitudes.begin() + (kMaxCoefficients - 1);
    std::nth_element(magnitudes.begin(), last, magnitudes.end(), std::greater<>());
    return *last == 0 ? 0.0F : std::bit_cast<float>(*last - 1);
}

}  // namespace

ChannelSignature truncate(const Plane& coefficients) {
    Largest largest(coarse_threshold(coefficients));
    std::array<std::uint8_t, kSide> places;
    for (int row = 0; row < kSide; ++row) {
        const auto values =
            std::span(coefficients).subspan(std::size_t(row) * kSide, kSide);
        // An equal magnitude later on has the larger index and loses: strictly above.
        const int count = places_above(values, largest.threshold(), places.data());
        for (const std::uint8_t place : std::span(places).first(std::size_t(count))) {
            const int index = row * kSide + place;
            if (index > 0 && std::fabs(values[place]) > largest.threshold()) {
                largest.add(values[place], index);
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
    std::array<float, kSide> values;
    for (int row = 0; row < kSide; ++row) {
        std::copy_n(coefficients.begin() + row * kSide, kSide, values.begin());
        if (row == 0) values[0] = 0.0F;
        std::array<float, kLanes> lanes{};
        for (int begin = 0; begin < kSide; begin += kLanes) {
            for (int lane = 0; lane < kLanes; ++lane) {
                const float value = values[begin + lane];
                lanes[lane] += value * value;
            }
        }
        for (const float lane : lanes) energy += double{lane};
    }
    return energy;
}

}  // namespace haarmony::image
