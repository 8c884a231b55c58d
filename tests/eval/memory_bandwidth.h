// How fast one core reads memory in order: the bound of a search that touches every picture.
//
// Units   bytes a second of the thread's CPU time.
#pragma once

#include <cstddef>

namespace haarmony::eval {

// The best of `passes` over a buffer that no cache holds.
// Requires: bytes >= 4096, passes >= 1. Cost: that memory, for a moment.
[[nodiscard]] double memory_bandwidth(std::size_t bytes, int passes);

}  // namespace haarmony::eval
