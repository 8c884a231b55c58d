// What a child of ours denies itself before it sees a byte of unknown origin.
//
// Errors  false where the system refuses a limit.
#pragma once

#include <cstdint>

namespace haarmony::ingest {

// The only argument of a child, in bytes; 0 where it was started by hand.
[[nodiscard]] std::uint64_t address_space_argument(int argc, char** argv);

// No more address space than that, no files, no core dumps, no new rights.
[[nodiscard]] bool confine(std::uint64_t address_space);

// So much processor time from now on. The limit counts from the start of the process: it
// moves up for each task.
[[nodiscard]] bool allow_seconds(std::int64_t seconds);

}  // namespace haarmony::ingest
