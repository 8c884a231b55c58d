#include "engine/image/best_kept.h"

#include <cassert>

namespace haarmony::image {

BestKept::BestKept(int limit) : top_(limit) { assert(limit >= 1); }

void BestKept::offer(const Match& match) {
    const std::lock_guard lock(mutex_);
    top_.offer(match);
    if (top_.full()) worst_.store(top_.worst(), std::memory_order_relaxed);
}

std::vector<Match> BestKept::take() {
    const std::lock_guard lock(mutex_);
    worst_.store(kAny, std::memory_order_relaxed);
    return top_.take();
}

}  // namespace haarmony::image
