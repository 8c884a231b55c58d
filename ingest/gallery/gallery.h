// The generated gallery: any number of pictures worth searching, from one seed.
//   painters.h (scenes) -> varnish.h (bytes) -> [gallery.h] -> export.h (files)
//
// Picture i is the same whatever else is made, on every machine; its kind is i modulo
// kKinds, so that the first few pictures already show every kind.
//
// Shape   row-major, three bytes a pixel, tightly packed; about 2:1 to 2:3.
// Units   sRGB bytes.
// Errors  none at run time; a number or side out of range is a caller's bug and asserts.
// Threads const-safe; about 0.1 s of one core for a longest side of 720.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace haarmony::gallery {

inline constexpr int kKinds = 10;
inline constexpr int kLeastSide = 16;
inline constexpr int kLargestSide = 4096;

struct Painting {
    std::string title;  // e.g. "Mountain lake at dusk"
    std::string kind;   // e.g. "landscape"; the first of the tags
    std::vector<std::string> tags;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

// Requires: number >= 0, kLeastSide <= longest_side <= kLargestSide.
[[nodiscard]] Painting paint(std::uint64_t seed, int number, int longest_side);

// The longest side that picture `number` has in the gallery: 640 to 800.
[[nodiscard]] int gallery_side(std::uint64_t seed, int number);

}  // namespace haarmony::gallery
