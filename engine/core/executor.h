// Who runs work that may run in parallel: the engine itself starts no threads.
//
// Threads  parallel_for returns when every call has returned; calls may come from any
//          thread, in any order, and at the same time.
#pragma once

#include <cstddef>
#include <functional>

namespace haarmony {

class Executor {
  public:
    virtual ~Executor() = default;

    // Calls work(i) once for each i in [0, count). Requires: work does not throw.
    virtual void parallel_for(std::size_t count,
                              const std::function<void(std::size_t)>& work) = 0;
};

// Runs everything on the calling thread, in order.
class InlineExecutor final : public Executor {
  public:
    void parallel_for(std::size_t count,
                      const std::function<void(std::size_t)>& work) override {
        for (std::size_t i = 0; i < count; ++i) work(i);
    }
};

}  // namespace haarmony
