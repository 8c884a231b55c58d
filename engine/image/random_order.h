// Random choices that are the same with every standard library: std::shuffle and the
// standard distributions are not.
#pragma once

#include <cassert>
#include <cstdint>
#include <random>
#include <span>
#include <utility>

namespace haarmony::image {

// A number in [0, bound). 64 random bits: the bias is below bound / 2^64.
// Requires: bound > 0.
[[nodiscard]] inline std::uint64_t random_below(std::mt19937_64& random,
                                                std::uint64_t bound) {
    assert(bound > 0);
    return random() % bound;
}

// Puts `count` of the items, drawn without replacement, in front of the others.
// Requires: count <= items.size().
template <typename T>
void draw_to_front(std::mt19937_64& random, std::span<T> items, std::size_t count) {
    assert(count <= items.size());
    for (std::size_t i = 0; i < count; ++i) {
        std::swap(items[i], items[i + random_below(random, items.size() - i)]);
    }
}

}  // namespace haarmony::image
