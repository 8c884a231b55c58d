// The bricks of one layer, as they are held in memory.
//   brick.h -> [bricks.h] -> layer.h
//
// Errors   none; an index past the end is a caller's bug and asserts.
// Threads  const-thread-safe.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "engine/video/brick.h"

namespace haarmony::video {

class Bricks {
  public:
    [[nodiscard]] std::size_t size() const { return bricks_.size(); }
    [[nodiscard]] bool empty() const { return bricks_.empty(); }
    void clear() { bricks_.clear(); }  // and keeps the memory
    void reserve(std::size_t count) { bricks_.reserve(count); }
    void shrink_to_fit() { bricks_.shrink_to_fit(); }
    void push_back(const Brick& brick) { bricks_.push_back(brick); }

    [[nodiscard]] Brick operator[](std::size_t i) const {
        assert(i < size());
        return bricks_[i];
    }
    void get(std::size_t i, Brick& brick) const {
        assert(i < size());
        brick = bricks_[i];
    }
    // Whether brick i is `brick`, byte for byte.
    [[nodiscard]] bool equals(std::size_t i, const Brick& brick) const {
        assert(i < size());
        return bricks_[i] == brick;
    }

    [[nodiscard]] std::size_t memory_bytes() const {
        return bricks_.size() * sizeof(Brick);
    }
    friend bool operator==(const Bricks&, const Bricks&) = default;

  private:
    std::vector<Brick> bricks_;
};

}  // namespace haarmony::video
