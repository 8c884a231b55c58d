// Rows with the signatures of pictures, from a file of haarmony-eval speed --cache.
//   tests/eval/signature_cache.h -> [cached_rows.h] -> synthetic_rows.h
//
// Errors  those of the file and of the database; kInvalidArgument, naming the file and both
//         numbers, where it has fewer pictures than are wanted. Nothing is written then.
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/result.h"

namespace haarmony::bench {

// Adds rows 1 to `images`, with the first signatures of the file.
[[nodiscard]] Result<void> write_cached_rows(const std::string& database,
                                             std::int64_t images,
                                             const std::string& cache);

}  // namespace haarmony::bench
