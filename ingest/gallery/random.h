// Random numbers that are the same everywhere: splitmix64, and distributions of our own,
// since the standard library's differ between implementations.
//
// Threads one Random a thread.
// Source  Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace haarmony::gallery {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] std::uint64_t next();

    // In [0, 1), a multiple of 2^-53.
    [[nodiscard]] double unit();
    // In [low, high).
    [[nodiscard]] double between(double low, double high);
    // In [0, bound), every value equally likely. Requires: bound >= 1.
    [[nodiscard]] int below(int bound);
    [[nodiscard]] bool chance(double probability) { return unit() < probability; }
    // -1 or 1.
    [[nodiscard]] double sign() { return chance(0.5) ? 1 : -1; }
    // Bell shaped with mean 0 and deviation 1, never beyond 6: a sum of twelve.
    [[nodiscard]] double bell();

    // Requires: choices not empty.
    template <typename T, std::size_t N>
    [[nodiscard]] const T& pick(const T (&choices)[N]) {
        return choices[below(static_cast<int>(N))];
    }
    template <typename T>
    [[nodiscard]] const T& pick(std::span<const T> choices) {
        return choices[static_cast<std::size_t>(below(static_cast<int>(choices.size())))];
    }

    // A seed for noise.h.
    [[nodiscard]] std::uint32_t noise_seed() {
        return static_cast<std::uint32_t>(next() >> 32);
    }

  private:
    std::uint64_t state_;
};

// A well spread value of both arguments: the seed of one picture among many.
[[nodiscard]] std::uint64_t mix_seeds(std::uint64_t seed, std::uint64_t stream);

}  // namespace haarmony::gallery
