#include "ingest/gallery/random.h"

#include <cassert>

namespace haarmony::gallery {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15ULL;

std::uint64_t finalize(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}

}  // namespace

std::uint64_t Random::next() {
    state_ += kGoldenGamma;
    return finalize(state_);
}

double Random::unit() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Random::between(double low, double high) { return low + (high - low) * unit(); }

int Random::below(int bound) {
    assert(bound >= 1);
    // Values above the last multiple of the bound would favour the small ones.
    const auto range = static_cast<std::uint64_t>(bound);
    const std::uint64_t limit = UINT64_MAX - UINT64_MAX % range;
    std::uint64_t value = next();
    while (value >= limit) value = next();
    return static_cast<int>(value % range);
}

double Random::bell() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
}

std::uint64_t mix_seeds(std::uint64_t seed, std::uint64_t stream) {
    return finalize(finalize(seed + kGoldenGamma) ^ (stream * kGoldenGamma));
}

}  // namespace haarmony::gallery
