// Things that one thread at a time may use, made on demand and lent out: database
// connections, decoders.
//
// Errors  what the factory answers, from lend().
// Threads lend() from any thread; a Loan belongs to one thread and must end before its pool.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::server {

template <typename T>
class LendingPool {
  public:
    using Factory = std::function<Result<std::unique_ptr<T>>()>;

    class Loan {
      public:
        Loan(LendingPool& pool, std::unique_ptr<T> item)
            : pool_(&pool), item_(std::move(item)) {}
        Loan(Loan&&) noexcept = default;
        Loan& operator=(Loan&&) = delete;
        ~Loan() {
            if (item_) pool_->give_back(std::move(item_));
        }

        [[nodiscard]] T& operator*() const { return *item_; }
        [[nodiscard]] T* operator->() const { return item_.get(); }

      private:
        LendingPool* pool_;
        std::unique_ptr<T> item_;
    };

    explicit LendingPool(Factory factory) : factory_(std::move(factory)) {}
    LendingPool(const LendingPool&) = delete;
    LendingPool& operator=(const LendingPool&) = delete;

    // A free one, or a new one. There are never more than were in use at the same time.
    [[nodiscard]] Result<Loan> lend() {
        {
            const std::lock_guard lock(mutex_);
            if (!free_.empty()) {
                std::unique_ptr<T> item = std::move(free_.back());
                free_.pop_back();
                return Loan(*this, std::move(item));
            }
        }
        Result<std::unique_ptr<T>> made = factory_();
        if (!made) return std::move(made).error();
        return Loan(*this, std::move(made).value());
    }

  private:
    void give_back(std::unique_ptr<T> item) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(item));
    }

    Factory factory_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> free_;
};

}  // namespace haarmony::server
