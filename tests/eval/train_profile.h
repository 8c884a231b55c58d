// haarmony-eval train: a profile from a file of training pairs, written into a database,
// beside a running daemon too, whose next query uses it.
//
// Shape   one JSON object a line, as POST /feedback takes it and GET /feedback/export gives
//         it; lines of white space alone are passed over.
// Errors  on `err`, each bad line by its number; nothing is learned where one is bad.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace haarmony::eval {

struct TrainProfileOptions {
    std::string database;  // must exist
    std::string pairs;     // file
    std::string profile;
    std::string base = "painted";
    std::string kind;  // only pairs of this kind; empty: all
    bool replace_worse = false;
    std::uint64_t seed = 1;
};

inline constexpr int kExitStored = 0;
inline constexpr int kExitWorse = 1;  // fitted, but not stored
inline constexpr int kExitUsage = 2;
inline constexpr int kExitFailed = 3;

// The report goes to `out`. Returns the exit code.
[[nodiscard]] int train_profile(const TrainProfileOptions& options,
                                std::ostream& out,
                                std::ostream& err);

}  // namespace haarmony::eval
