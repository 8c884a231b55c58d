// The best few of many matches (Heap-Select).
//
// Order   smaller score first, ties to the smaller id: a total order, so that the result
//         does not depend on the order of the offers.
// Source  sec. 4.3.2, last paragraph.
#pragma once

#include <vector>

#include "engine/image/query.h"

namespace haarmony::image {

class TopK {
  public:
    // Requires: limit >= 1.
    explicit TopK(int limit);

    // Whether as many are kept as are wanted; from then on worst() is the score to beat.
    [[nodiscard]] bool full() const { return heap_.size() == limit_; }
    // Requires: full().
    [[nodiscard]] Score worst() const { return heap_.front().score; }

    // Cost: constant where the match is not kept, else logarithmic in the limit.
    void offer(const Match& match);

    // What was kept, best first; leaves nothing behind.
    [[nodiscard]] std::vector<Match> take();

  private:
    std::size_t limit_;
    std::vector<Match> heap_;  // the worst on top
};

}  // namespace haarmony::image
