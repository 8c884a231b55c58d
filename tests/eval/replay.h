// haarmony-eval replay: the paintings that people logged with POST /feedback, painted again
// stroke by stroke, to see after how many of them the target was among the 20 best.
//
// Nested databases: the targets, and growing shares of the other pictures.
//
// Units   times are estimates: the logged seconds of a whole painting, spread evenly over its
//         strokes.
// Source  sec. 4.5.6, Figure 4.9.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/index.h"
#include "engine/image/profile.h"
#include "engine/image/strokes.h"

namespace haarmony::eval {

struct ReplayOptions {
    std::string database;  // must exist
    std::string profile = "painted";
    int m = 20;  // the dissertation's for interactive queries
    int databases = 4;
    std::uint64_t seed = 1;  // of who is in which database
};

struct LoggedPainting {
    image::StrokePicture strokes;
    ImageId target{};
    std::optional<double> seconds;
};

// The number of strokes after which the target is among the `limit` best, for the first time;
// nothing where it never is. Requires: m <= the snapshot's.
[[nodiscard]] std::optional<int> strokes_to_target(const LoggedPainting& painting,
                                                   const image::IndexSnapshot& snapshot,
                                                   const image::Profile& profile,
                                                   int m,
                                                   int limit);

struct ReplayRow {
    std::int64_t pictures = 0;
    std::vector<std::optional<int>> strokes;  // one a painting
};

// One row for each database, the smallest first.
[[nodiscard]] std::vector<ReplayRow> replay(std::span<const LoggedPainting> paintings,
                                            std::vector<image::Record> pictures,
                                            const image::Profile& profile,
                                            const ReplayOptions& options);

// The table of the rows goes to `out`. kNotFound where nothing was painted yet.
[[nodiscard]] Result<void> replay_database(const ReplayOptions& options,
                                           std::ostream& out);

}  // namespace haarmony::eval
