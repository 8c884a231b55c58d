#include "engine/video/linked_nodes.h"

#include <algorithm>

namespace haarmony::video {

void LinkedNodes::compact() {
    const bool childless =
        std::all_of(nodes_.begin(), nodes_.end(), [](const LinkedNode& n) {
            return n.child == kNone;
        });
    if (childless && leaves_.empty()) {
        leaves_.reserve(nodes_.size());
        for (const LinkedNode& node : nodes_) leaves_.push_back(node.brick);
        nodes_.clear();
    }
    nodes_.shrink_to_fit();
    leaves_.shrink_to_fit();
}

bool operator==(const LinkedNodes& a, const LinkedNodes& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] != b[i]) return false;
    }
    return true;
}

}  // namespace haarmony::video
