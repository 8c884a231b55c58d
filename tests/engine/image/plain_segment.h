// The bytes of a segment by definition (FORMATS.md): every list collected, every bit set on
// its own. What the builder is compared with.
#pragma once

#include <span>

#include "engine/image/record.h"
#include "engine/image/segment_builder.h"

namespace haarmony::image {

// Requires: ids rising.
[[nodiscard]] BuiltSegment plain_segment(std::span<const Record> records, int index_m);

}  // namespace haarmony::image
