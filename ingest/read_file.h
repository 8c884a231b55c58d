// The whole of one file, as it was at one moment, within a share of the byte budget.
//
// Errors  kNotFound: gone, or no regular file any more (never opened for longer than a look);
//         kTooLarge, kIo; kUnavailable: it changed during every attempt to read it.
// Threads const-safe but for the budget, which waits for other threads' shares.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "ingest/byte_budget.h"
#include "ingest/walk.h"

namespace haarmony::ingest {

inline constexpr int kReadAttempts = 3;

struct FileContent {
    ByteBudget::Share share;
    std::vector<std::uint8_t> bytes;
    FileLook look;  // before and after the bytes were read
};

struct ReadLimits {
    std::int64_t max_bytes = std::int64_t{1} << 30;
    // Called after the bytes are read and before the second look at the file.
    std::function<void()> before_second_look = [] {};
};

// Requires: `path` is absolute.
[[nodiscard]] Result<FileContent> read_file(const std::string& path,
                                            const ReadLimits& limits,
                                            ByteBudget& budget);

}  // namespace haarmony::ingest
