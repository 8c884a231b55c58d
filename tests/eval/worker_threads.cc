#include "tests/eval/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <thread>
#include <vector>

namespace haarmony::eval {

WorkerThreads::WorkerThreads(int threads) : threads_(threads) { assert(threads >= 1); }

void WorkerThreads::parallel_for(std::size_t count,
                                 const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> others;
    const std::size_t useful = std::min<std::size_t>(threads_, count);
    for (std::size_t i = 1; i < useful; ++i) others.emplace_back(run);
    run();
}

}  // namespace haarmony::eval
