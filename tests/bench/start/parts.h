// The parts of a start over one database, each measured once.
//
// Units   seconds of wall time, and of processor time of all threads, which says what there
//         is to do where other programs want the cores, too.
// Errors  std::runtime_error naming what failed.
#pragma once

#include <cstdint>
#include <string>

namespace haarmony::bench {

struct PartsOptions {
    std::string database;
    int index_m = 60;
    int threads = 1;
};

// Every signature out of the database and decoded, no segment made of it.
struct ReadTime {
    std::int64_t images = 0;
    double seconds = 0;
    double processor_seconds = 0;
};
[[nodiscard]] ReadTime read_signatures(const PartsOptions& options);

// The same, with the segments, and a snapshot file of what came of it.
struct RebuildTime {
    std::int64_t images = 0;
    double seconds = 0;
    double processor_seconds = 0;
    std::uint64_t snapshot_bytes = 0;
    double snapshot_seconds = 0;  // to write the file and to check it
};
[[nodiscard]] RebuildTime rebuild_and_write(const PartsOptions& options,
                                            const std::string& snapshot);

// The file mapped, its checksums and its bounds, until it could be searched; and the checksums
// alone, which is what reading its bytes costs.
struct MapTime {
    double seconds = 0;
    double processor_seconds = 0;
    double checksum_seconds = 0;
};
[[nodiscard]] MapTime map_snapshot(const PartsOptions& options,
                                   const std::string& snapshot);

}  // namespace haarmony::bench
