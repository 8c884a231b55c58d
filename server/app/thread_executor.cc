#include "server/app/thread_executor.h"

#include <algorithm>

namespace haarmony::server {

ThreadExecutor::ThreadExecutor(int threads) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

ThreadExecutor::~ThreadExecutor() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void ThreadExecutor::parallel_for(std::size_t count,
                                  const std::function<void(std::size_t)>& work) {
    if (count == 0) return;
    const auto batch = std::make_shared<Batch>(work, count);
    {
        const std::lock_guard lock(mutex_);
        batches_.push_back(batch);
    }
    wake_.notify_all();
    take_part(*batch);
    std::unique_lock lock(mutex_);
    std::erase(batches_, batch);
    finished_.wait(lock, [&] { return batch->done == count; });
}

void ThreadExecutor::take_part(Batch& batch) {
    for (;;) {
        const std::size_t i = batch.next++;
        if (i >= batch.count) return;
        batch.work(i);
        if (++batch.done < batch.count) continue;
        // Under the lock, or the caller could miss it between its look and its sleep.
        const std::lock_guard lock(mutex_);
        finished_.notify_all();
    }
}

void ThreadExecutor::serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return stopping_ || !batches_.empty(); });
        if (stopping_) return;
        const std::shared_ptr<Batch> batch = batches_.front();
        lock.unlock();
        take_part(*batch);
        lock.lock();
        std::erase(batches_, batch);
    }
}

}  // namespace haarmony::server
