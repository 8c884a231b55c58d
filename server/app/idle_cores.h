// The cores that a search may use beside its own thread: all while few searches run, none
// while there are enough searches to keep every core busy.
//
//   image_service -> [idle_cores] -> thread_executor -> the engine's parallel search
//
// A search that is alone is answered sooner by several cores; a search among many would only
// take them from the others and pay for the hand-over.
//
// Threads  every member from any thread.
#pragma once

#include <atomic>

#include "engine/core/executor.h"
#include "server/app/thread_executor.h"

namespace haarmony::server {

class IdleCores {
  public:
    // Counts one search as long as it lives.
    class Share {
      public:
        explicit Share(IdleCores& cores);
        ~Share();
        Share(const Share&) = delete;
        Share& operator=(const Share&) = delete;

        // Null: the calling thread alone. Decided once, when the search begins.
        [[nodiscard]] Executor* executor() const { return executor_; }

      private:
        IdleCores& cores_;
        Executor* executor_ = nullptr;
    };

    // So many cores in all, those of the searches included. Requires: cores >= 1.
    explicit IdleCores(int cores);

  private:
    const int cores_;
    std::atomic<int> running_ = 0;
    ThreadExecutor threads_;
};

}  // namespace haarmony::server
