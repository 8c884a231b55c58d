#include "server/http/worker_pool.h"

#include <algorithm>
#include <utility>

namespace haarmony::http {

WorkerPool::WorkerPool(int threads, int queue_limit)
    : queue_limit_(static_cast<std::size_t>(std::max(1, queue_limit))) {
    for (int i = 0; i < std::max(1, threads); ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

WorkerPool::~WorkerPool() { stop(); }

std::optional<WorkerPool::Ticket> WorkerPool::submit(Job job) {
    const std::lock_guard lock(mutex_);
    if (stopping_ || queue_.size() >= queue_limit_) return std::nullopt;
    const Ticket ticket = next_++;
    queue_.emplace_hint(queue_.end(), ticket, std::move(job));
    changed_.notify_one();
    return ticket;
}

bool WorkerPool::cancel(Ticket ticket) {
    // The job is destroyed after the lock is released: its destructors may come back here.
    std::map<Ticket, Job>::node_type removed;
    const std::lock_guard lock(mutex_);
    removed = queue_.extract(ticket);
    return !removed.empty();
}

void WorkerPool::discard() {
    // Destroyed after the lock is released, as in cancel().
    std::map<Ticket, Job> dropped;
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    dropped.swap(queue_);
    changed_.notify_all();
}

void WorkerPool::stop() {
    discard();
    for (std::thread& thread : threads_) {
        if (thread.joinable()) thread.join();
    }
}

std::size_t WorkerPool::queued() const {
    const std::lock_guard lock(mutex_);
    return queue_.size();
}

void WorkerPool::work() {
    for (;;) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
            if (stopping_) return;
            job = std::move(queue_.extract(queue_.begin()).mapped());
        }
        job();
    }
}

}  // namespace haarmony::http
