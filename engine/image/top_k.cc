#include "engine/image/top_k.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace haarmony::image {

TopK::TopK(int limit) : limit_(static_cast<std::size_t>(limit)) { assert(limit >= 1); }

void TopK::offer(const Match& match) {
    if (full()) {
        if (!better(match, heap_.front())) return;
        std::pop_heap(heap_.begin(), heap_.end(), better);
        heap_.back() = match;
    } else {
        heap_.push_back(match);
    }
    std::push_heap(heap_.begin(), heap_.end(), better);
}

std::vector<Match> TopK::take() {
    std::sort_heap(heap_.begin(), heap_.end(), better);
    return std::exchange(heap_, {});
}

}  // namespace haarmony::image
