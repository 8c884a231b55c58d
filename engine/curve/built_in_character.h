// Characters that are there before anybody draws one: strokes of ours, made by code.
//   points.h -> [built_in_character.h] -> character.h
//
// Shape    open strokes of level kBuiltInLevel, x and y, about a line from left to right.
// Units    a page of 1000 x 1000; on other pages a strength or Frame::kUnnormalized scales.
// Errors   none.
// Threads  const-thread-safe.
// Source   sec. 3.4.2, the "curve character library".
#pragma once

#include <span>
#include <string_view>

#include "engine/curve/points.h"

namespace haarmony::curve {

inline constexpr int kBuiltInLevel = 8;

struct BuiltInCharacter {
    std::string_view name;
    Points (*stroke)() = nullptr;  // the control points; the same at every call
};

// In the order of their names.
[[nodiscard]] std::span<const BuiltInCharacter> built_in_characters();

// None of that name: nullptr.
[[nodiscard]] const BuiltInCharacter* built_in_character(std::string_view name);

}  // namespace haarmony::curve
