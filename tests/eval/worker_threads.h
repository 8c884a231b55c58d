// An Executor with threads of its own, for evaluation runs.
//
// Threads  parallel_for may be called from any thread, also from within work: every call
//          starts its threads and joins them.
#pragma once

#include "engine/core/executor.h"

namespace haarmony::eval {

class WorkerThreads final : public Executor {
  public:
    // Requires: threads >= 1.
    explicit WorkerThreads(int threads);

    // Work is handed out one index at a time, in order.
    void parallel_for(std::size_t count,
                      const std::function<void(std::size_t)>& work) override;

  private:
    int threads_;
};

}  // namespace haarmony::eval
