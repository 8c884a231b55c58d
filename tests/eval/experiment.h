// What every protocol of an evaluation shares: the database, the pictures that queries are
// made of, and random numbers that depend on nothing but the seed, the protocol and the
// picture.
//
// Shape   the database in a random order; its first pictures are asked for (`evaluation`,
//         and `distorted` for Figure 4.7), its last ones train the metric (`fitting` for
//         weights, `selection` for the choices of Figure 4.5). The two ends overlap only
//         where there are too few pictures; the two training sets never do.
// Threads const-safe.
// Source  sec. 4.5, 4.5.1 (85 and 85), 4.5.3 (100).
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "engine/core/executor.h"
#include "tests/eval/database.h"
#include "tests/eval/simulated_queries.h"

namespace haarmony::eval {

// The trainer keeps a tenth of its pairs back for itself: 85 are left for the weights.
inline constexpr int kFittingQueries = 94;
inline constexpr int kSelectionQueries = 85;
inline constexpr int kDistortedPictures = 100;
// Query pictures are no larger: every metric looks at 128 x 128 averages.
inline constexpr int kQuerySide = 256;

class Experiment {
  public:
    // Requires: queries >= 1, two pictures at least. Errors: those of the source, for a picture that could be read
    // a moment ago.
    [[nodiscard]] static Result<Experiment> prepare(const PictureSource& source,
                                                    const Database& database,
                                                    std::uint64_t seed,
                                                    int queries,
                                                    Executor& executor);

    [[nodiscard]] const Database& database() const { return *database_; }
    [[nodiscard]] Executor& executor() const { return *executor_; }
    [[nodiscard]] std::uint64_t seed() const { return seed_; }

    // Places in the database.
    [[nodiscard]] const std::vector<std::size_t>& evaluation() const {
        return evaluation_;
    }
    [[nodiscard]] const std::vector<std::size_t>& distorted() const { return distorted_; }
    [[nodiscard]] const std::vector<std::size_t>& fitting() const { return fitting_; }
    [[nodiscard]] const std::vector<std::size_t>& selection() const { return selection_; }
    [[nodiscard]] bool training_overlaps() const { return training_overlaps_; }

    // Requires: `place` is in one of the sets.
    [[nodiscard]] const RgbPicture& picture(std::size_t place) const;

    [[nodiscard]] Random random(std::string_view protocol, std::size_t place) const;

    // The simulated query for a picture, the same whoever asks.
    [[nodiscard]] QueryPicture query(QueryKind kind, std::size_t place) const;

  private:
    Experiment() = default;

    const Database* database_ = nullptr;
    Executor* executor_ = nullptr;
    std::uint64_t seed_ = 0;
    std::vector<std::size_t> evaluation_;
    std::vector<std::size_t> distorted_;
    std::vector<std::size_t> fitting_;
    std::vector<std::size_t> selection_;
    bool training_overlaps_ = false;
    std::map<std::size_t, RgbPicture> pictures_;
};

// 0 .. count - 1 in a random order.
[[nodiscard]] std::vector<std::size_t> shuffled(std::size_t count, Random& random);

}  // namespace haarmony::eval
