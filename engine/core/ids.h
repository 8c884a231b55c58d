// Identifiers as types of their own, so that an id is never taken for an index.
//
// Units   ImageId: the row id in the database, >= 1, never reused.
#pragma once

#include <cstdint>

namespace haarmony {

enum class ImageId : std::int64_t {};

[[nodiscard]] constexpr std::int64_t to_int(ImageId id) {
    return static_cast<std::int64_t>(id);
}

}  // namespace haarmony
