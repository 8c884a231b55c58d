// How many bytes of files all workers together may hold in memory.
//
// Scale   a share larger than the whole budget is given out alone.
// Threads take() waits; shares are given in the order in which they were asked for, so that
//         a large file is not passed over for ever by small ones.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <utility>

namespace haarmony::ingest {

class ByteBudget {
  public:
    // Gives its bytes back when it ends.
    class Share {
      public:
        Share() = default;
        Share(Share&& other) noexcept
            : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_) {}
        Share& operator=(Share&& other) noexcept {
            std::swap(budget_, other.budget_);
            std::swap(bytes_, other.bytes_);
            return *this;
        }
        ~Share() {
            if (budget_ != nullptr) budget_->give_back(bytes_);
        }

      private:
        friend class ByteBudget;
        Share(ByteBudget* budget, std::int64_t bytes) : budget_(budget), bytes_(bytes) {}

        ByteBudget* budget_ = nullptr;
        std::int64_t bytes_ = 0;
    };

    explicit ByteBudget(std::int64_t bytes) : total_(bytes) {}

    // Requires: the calling thread holds no other share; bytes >= 0.
    [[nodiscard]] Share take(std::int64_t bytes) {
        std::unique_lock lock(mutex_);
        const std::uint64_t turn = next_turn_++;
        changed_.wait(lock, [&] {
            return turn == turn_ && (in_use_ == 0 || in_use_ + bytes <= total_);
        });
        in_use_ += bytes;
        ++turn_;
        lock.unlock();
        changed_.notify_all();
        return Share(this, bytes);
    }

    [[nodiscard]] std::int64_t in_use() const {
        const std::lock_guard lock(mutex_);
        return in_use_;
    }

    // Threads that wait in take().
    [[nodiscard]] std::uint64_t waiting() const {
        const std::lock_guard lock(mutex_);
        return next_turn_ - turn_;
    }

  private:
    void give_back(std::int64_t bytes) {
        {
            const std::lock_guard lock(mutex_);
            in_use_ -= bytes;
        }
        changed_.notify_all();
    }

    const std::int64_t total_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::int64_t in_use_ = 0;
    std::uint64_t next_turn_ = 0;
    std::uint64_t turn_ = 0;
};

}  // namespace haarmony::ingest
