// A first-in first-out queue of limited length between threads.
//
// Scale   push waits while `capacity` items are queued.
// Threads any number on either end. close() wakes everybody: push refuses from then on,
//         pop hands out what is left and then nothing.
#pragma once

#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace haarmony::ingest {

template <typename T>
class BoundedQueue {
  public:
    using Clock = std::chrono::steady_clock;

    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {
        assert(capacity > 0);
    }

    // False when the queue is closed; the item is dropped then.
    bool push(T item) {
        std::unique_lock lock(mutex_);
        space_.wait(lock, [this] { return closed_ || items_.size() < capacity_; });
        if (closed_) return false;
        items_.push_back(std::move(item));
        lock.unlock();
        ready_.notify_one();
        return true;
    }

    // Nothing when the queue is closed and empty.
    [[nodiscard]] std::optional<T> pop() {
        std::unique_lock lock(mutex_);
        ready_.wait(lock, [this] { return closed_ || !items_.empty(); });
        return take(lock);
    }

    // Nothing as well when `deadline` passes first.
    [[nodiscard]] std::optional<T> pop_until(Clock::time_point deadline) {
        std::unique_lock lock(mutex_);
        ready_.wait_until(lock, deadline, [this] { return closed_ || !items_.empty(); });
        return take(lock);
    }

    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        ready_.notify_all();
        space_.notify_all();
    }

    // Closed, and nothing left to pop.
    [[nodiscard]] bool exhausted() const {
        const std::lock_guard lock(mutex_);
        return closed_ && items_.empty();
    }

  private:
    std::optional<T> take(std::unique_lock<std::mutex>& lock) {
        if (items_.empty()) return std::nullopt;
        std::optional<T> item(std::move(items_.front()));
        items_.pop_front();
        lock.unlock();
        space_.notify_one();
        return item;
    }

    const std::size_t capacity_;
    mutable std::mutex mutex_;
    std::condition_variable ready_;
    std::condition_variable space_;
    std::deque<T> items_;
    bool closed_ = false;
};

}  // namespace haarmony::ingest
