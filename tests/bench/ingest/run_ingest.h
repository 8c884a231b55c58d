// All of ingest, from a folder to a database on disk.
#pragma once

#include <cstdint>
#include <string>

namespace haarmony::bench {

struct IngestRun {
    std::int64_t added = 0;
    std::int64_t failed = 0;
    double wall_seconds = 0;
    double processor_seconds = 0;  // of all threads
};

// One worker, into a new database in a new folder below the system's temporary one, which is
// removed afterwards. Ends the program where it cannot be run.
[[nodiscard]] IngestRun run_ingest(const std::string& folder);

}  // namespace haarmony::bench
