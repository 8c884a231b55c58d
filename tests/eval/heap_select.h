// "Heap-Select": the few smallest of many values.
//
// Source  sec. 4.3.2, last paragraph.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace haarmony::eval {

template <typename T>
class HeapSelect {
  public:
    // Keeps `limit` values.
    explicit HeapSelect(std::size_t limit) : limit_(limit) { heap_.reserve(limit); }

    void offer(const T& value) {
        if (heap_.size() < limit_) {
            heap_.push_back(value);
            std::ranges::push_heap(heap_);
        } else if (limit_ > 0 && value < heap_.front()) {
            std::ranges::pop_heap(heap_);
            heap_.back() = value;
            std::ranges::push_heap(heap_);
        }
    }

    // What was kept, the smallest first; leaves nothing behind.
    [[nodiscard]] std::vector<T> take() {
        std::ranges::sort_heap(heap_);
        return std::exchange(heap_, {});
    }

  private:
    std::size_t limit_;
    std::vector<T> heap_;  // the largest on top
};

}  // namespace haarmony::eval
