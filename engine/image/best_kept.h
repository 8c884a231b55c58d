// The best matches that all who search for one query have found so far, and the score that
// another one has to reach.
//   top_k.h -> [best_kept.h] -> segment_search.h
//
// One for all threads, because what one of them finds spares the others work.
//
// Order    as TopK: the result does not depend on the order of the offers.
// Threads  every member from any thread; offers are rare enough for a lock.
// Source   sec. 4.3.2, last paragraph.
#pragma once

#include <atomic>
#include <limits>
#include <mutex>
#include <vector>

#include "engine/image/query.h"
#include "engine/image/top_k.h"

namespace haarmony::image {

class BestKept {
  public:
    // What worst() is as long as fewer are kept than are wanted.
    static constexpr Score kAny = std::numeric_limits<Score>::max();

    // Requires: limit >= 1.
    explicit BestKept(int limit);

    // No match of a larger score is kept any more; ties may be. It only falls.
    [[nodiscard]] Score worst() const { return worst_.load(std::memory_order_relaxed); }

    void offer(const Match& match);

    // What was kept, best first; leaves nothing behind.
    [[nodiscard]] std::vector<Match> take();

  private:
    std::mutex mutex_;
    TopK top_;  // guarded by mutex_
    std::atomic<Score> worst_{kAny};
};

}  // namespace haarmony::image
