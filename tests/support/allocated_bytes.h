// How many bytes of the heap are in use: a program that links this counts every operator new
// and delete of its own.
//
// Units    bytes as they were asked for, those of all threads together.
// Threads  any.
#pragma once

#include <cstdint>

namespace haarmony::test {

[[nodiscard]] std::int64_t allocated_bytes();
// The most there have been since the last call of watch_allocated_bytes().
[[nodiscard]] std::int64_t most_allocated_bytes();
void watch_allocated_bytes();

}  // namespace haarmony::test
