// The nodes of one layer, and how they are held in memory.
//   brick.h -> [linked_nodes.h] -> layer.h
//
// Shape    a node names its brick and its four children by refs: the time level of the
//          siblings that own what is named, and its index in their layer of the space level.
// Memory   20 bytes a node. A list is compact when it has been told to be and none of its
//          nodes has a child, as none of a clip's finest level has, where most are: then 4.
// Errors   none; an index past the end and a change of a compact list are a caller's bugs and
//          assert.
// Threads  const-thread-safe.
// Source   sec. 5.2.2, Figure 5.4 [up-links].
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "engine/video/image_tree.h"

namespace haarmony::video {

enum class Ref : std::uint32_t {};
inline constexpr Ref kNoDetailRef{kNoDetail};
inline constexpr int kRefIndexBits = 27;
inline constexpr std::uint32_t kMaxRefIndex = (1U << kRefIndexBits) - 2;

[[nodiscard]] constexpr Ref make_ref(int time_level, std::uint32_t index) {
    return Ref{static_cast<std::uint32_t>(time_level) << kRefIndexBits | index};
}
[[nodiscard]] constexpr int time_level_of(Ref ref) {
    return static_cast<int>(static_cast<std::uint32_t>(ref) >> kRefIndexBits);
}
[[nodiscard]] constexpr std::uint32_t index_of(Ref ref) {
    return static_cast<std::uint32_t>(ref) & ((1U << kRefIndexBits) - 1);
}

struct LinkedNode {
    Ref brick = kNoDetailRef;  // never kNoDetailRef in a finished layer
    std::array<Ref, 4> child = {kNoDetailRef, kNoDetailRef, kNoDetailRef, kNoDetailRef};

    friend bool operator==(const LinkedNode&, const LinkedNode&) = default;
};

class LinkedNodes {
  public:
    LinkedNodes() = default;
    LinkedNodes(std::initializer_list<LinkedNode> nodes) : nodes_(nodes) {}

    [[nodiscard]] std::size_t size() const { return nodes_.size() + leaves_.size(); }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] LinkedNode operator[](std::size_t i) const {
        assert(i < size());
        return leaves_.empty() ? nodes_[i]
                               : LinkedNode{.brick = leaves_[i], .child = kNone};
    }
    [[nodiscard]] Ref brick(std::size_t i) const {
        assert(i < size());
        return leaves_.empty() ? nodes_[i].brick : leaves_[i];
    }

    // For a list that is not compact.
    [[nodiscard]] LinkedNode& operator[](std::size_t i) {
        assert(leaves_.empty() && i < size());
        return nodes_[i];
    }
    void reserve(std::size_t count) { nodes_.reserve(count); }
    void push_back(const LinkedNode& node) {
        assert(leaves_.empty());
        nodes_.push_back(node);
    }
    void resize(std::size_t count, const LinkedNode& node = {}) {
        assert(leaves_.empty());
        nodes_.resize(count, node);
    }
    void assign(std::size_t count, const LinkedNode& node) {
        clear();
        nodes_.assign(count, node);
    }

    // Keeps the memory for others.
    void clear() {
        nodes_.clear();
        leaves_.clear();
    }
    // Takes as little memory as it can. Nothing is changed until clear() or assign().
    void compact();

    [[nodiscard]] std::size_t memory_bytes() const {
        return nodes_.size() * sizeof(LinkedNode) + leaves_.size() * sizeof(Ref);
    }
    friend bool operator==(const LinkedNodes& a, const LinkedNodes& b);

  private:
    static constexpr std::array<Ref, 4> kNone = LinkedNode{}.child;

    // One of them is empty.
    std::vector<LinkedNode> nodes_;
    std::vector<Ref> leaves_;
};

}  // namespace haarmony::video
