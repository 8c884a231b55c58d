// What is said of a segment whose bytes no builder wrote (segment_bounds.cc, segment_check.cc).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/core/result.h"

namespace haarmony::image {

[[nodiscard]] inline Error corrupt(const std::string& what) {
    return {ErrorCode::kUndecodable, "a segment of the index is damaged: " + what};
}

[[nodiscard]] inline std::string at(const char* what,
                                    std::size_t place,
                                    const std::string& how) {
    return std::string(what) + " " + std::to_string(place) + " is " + how;
}

[[nodiscard]] inline std::string at(const char* what,
                                    std::size_t place,
                                    std::int64_t value) {
    return at(what, place, std::to_string(value));
}

}  // namespace haarmony::image
