// Weights rounded up for sums of bits: a sum costs one row for each one-bit of a weight, and
// what rounding adds makes more pictures look promising than are.
//   query.h -> [rounding.h] -> bit_sums.h, segment_search.h
//
// Units    a sum of units stands for units * unit() hundredths of a weight: never less than
//          the weights themselves.
// Errors   none.
// Threads  const-thread-safe.
// Source   sec. 4.3.2: bounds of the sums of Figure 4.2.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/image/query.h"

namespace haarmony::image {

class Rounding {
  public:
    // Finds what makes summing the query's terms cheap. Requires: no weight below 0.
    explicit Rounding(const Query& query);

    [[nodiscard]] std::int64_t unit() const { return unit_; }
    // What a weight of the query's is in units, at least. Requires: weight > 0.
    [[nodiscard]] std::uint32_t units(std::int32_t weight) const;
    // What so many units are worth.
    [[nodiscard]] std::int64_t weight(std::uint32_t units) const {
        return std::int64_t{units} * unit_;
    }
    // The fewest units that are worth `weight`; where no sum of the query's is worth as much,
    // more than any sum.
    [[nodiscard]] std::uint32_t units_for(std::int64_t weight) const;

  private:
    struct Weight {
        std::int32_t weight = 0;
        std::uint32_t units = 0;
        int terms = 0;
    };
    double round_all(std::int64_t unit, double sum);

    std::int64_t unit_ = 1;
    std::vector<Weight> weights_;  // each once, rising
};

}  // namespace haarmony::image
