// Which slots hold a picture that is gone: one bit each, never a special value of a
// signature. Published copies are immutable; a writer copies, sets and publishes anew.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace haarmony::image {

class Tombstones {
  public:
    explicit Tombstones(int slots) : words_((std::size_t(slots) + 63) / 64) {}

    [[nodiscard]] bool test(int slot) const {
        return (words_[std::size_t(slot) / 64] >> (slot % 64) & 1U) != 0;
    }

    // Requires: the bit is not set yet.
    void set(int slot) {
        words_[std::size_t(slot) / 64] |= std::uint64_t{1} << (slot % 64);
        ++count_;
    }

    [[nodiscard]] int count() const { return count_; }
    // Slot s is bit s % 64 of word s / 64.
    [[nodiscard]] std::span<const std::uint64_t> words() const { return words_; }
    [[nodiscard]] std::int64_t bytes() const {
        return std::int64_t(words_.size() * sizeof(std::uint64_t));
    }

  private:
    std::vector<std::uint64_t> words_;
    int count_ = 0;
};

// Null stands for "none": most segments never lose a picture.
using TombstonesPtr = std::shared_ptr<const Tombstones>;

[[nodiscard]] inline bool is_removed(const TombstonesPtr& removed, int slot) {
    return removed != nullptr && removed->test(slot);
}

[[nodiscard]] inline int removed_count(const TombstonesPtr& removed) {
    return removed == nullptr ? 0 : removed->count();
}

}  // namespace haarmony::image
