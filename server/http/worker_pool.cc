#include "server/http/worker_pool.h"

#include <sys/resource.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace haarmony::http {

WorkerPool::WorkerPool(int threads, int queue_limit, int niceness)
    : most_running_(std::max(1, threads)),
      queue_limit_(static_cast<std::size_t>(std::max(1, queue_limit))) {
    for (int i = 0; i < most_running_; ++i) {
        threads_.emplace_back([this, niceness] { work(niceness); });
    }
}

WorkerPool::~WorkerPool() { stop(); }

std::optional<WorkerPool::Ticket> WorkerPool::submit(Job job) {
    Ticket ticket = 0;
    {
        const std::lock_guard lock(mutex_);
        if (stopping_ || queue_.size() >= queue_limit_) return std::nullopt;
        ticket = next_++;
        queue_.emplace_hint(queue_.end(), ticket, std::move(job));
    }
    // Without the lock, for which the thread that wakes would only wait.
    changed_.notify_one();
    return ticket;
}

bool WorkerPool::run_here(const Job& job) {
    std::unique_lock lock(mutex_);
    if (stopping_ || !queue_.empty() || running_ == most_running_) return false;
    ++running_;
    lock.unlock();
    job();
    lock.lock();
    finish_one(lock);
    return true;
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
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return running_ == 0; });
}

std::size_t WorkerPool::queued() const {
    const std::lock_guard lock(mutex_);
    return queue_.size();
}

void WorkerPool::work(int niceness) {
    // On Linux 0 is the calling thread. Nobody is refused to give way.
    if (niceness > 0)
        ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + niceness);
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] {
            return stopping_ || (!queue_.empty() && running_ < most_running_);
        });
        if (stopping_) return;
        ++running_;
        {
            const Job job = std::move(queue_.extract(queue_.begin()).mapped());
            lock.unlock();
            job();
        }
        lock.lock();
        finish_one(lock);
    }
}

// The place of a job that ended is free for one that waits. Leaves the lock held.
void WorkerPool::finish_one(std::unique_lock<std::mutex>& lock) {
    assert(lock.owns_lock());
    --running_;
    if (stopping_)
        changed_.notify_all();
    else if (!queue_.empty())
        changed_.notify_one();
}

}  // namespace haarmony::http
