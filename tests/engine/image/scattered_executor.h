// An executor for tests: several threads at once, in no order.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "engine/core/executor.h"

namespace haarmony::image {

class ScatteredExecutor final : public Executor {
  public:
    explicit ScatteredExecutor(std::size_t threads) : threads_(threads) {}

    // The last first, on the caller's thread and on new ones.
    void parallel_for(std::size_t count,
                      const std::function<void(std::size_t)>& work) override {
        std::atomic<std::size_t> left = count;
        const auto take = [&] {
            for (std::size_t i = left.load(); i > 0;) {
                if (left.compare_exchange_weak(i, i - 1)) work(i - 1);
                i = left.load();
            }
        };
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min(threads_, count); ++i)
            others.emplace_back(take);
        take();
    }

  private:
    std::size_t threads_;
};

}  // namespace haarmony::image
