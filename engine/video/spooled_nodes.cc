#include "engine/video/spooled_nodes.h"

#include <algorithm>
#include <cassert>

namespace haarmony::video {

void SpooledNodes::add(int height, std::int64_t index, const SpooledNode& node) {
    const auto at_height = static_cast<std::size_t>(height);
    if (rows_.size() <= at_height) rows_.resize(at_height + 1);
    assert(rows_[at_height].empty() || rows_[at_height].back().index < index);
    if (node.uniform) {
        for (std::size_t below = 0; below < at_height; ++below) {
            const std::int64_t first = index << (at_height - below);
            std::vector<Row>& rows = rows_[below];
            while (!rows.empty() && rows.back().index >= first) rows.pop_back();
        }
    }
    rows_[at_height].push_back({index, node});
}

const SpooledNode& SpooledNodes::at(int height, std::int64_t index) const {
    const std::vector<Row>& rows = rows_[static_cast<std::size_t>(height)];
    const auto found = std::lower_bound(
        rows.begin(), rows.end(), index, [](const Row& row, std::int64_t wanted) {
            return row.index < wanted;
        });
    assert(found != rows.end() && found->index == index);
    return found->node;
}

std::size_t SpooledNodes::size() const {
    std::size_t nodes = 0;
    for (const std::vector<Row>& rows : rows_) nodes += rows.size();
    return nodes;
}

}  // namespace haarmony::video
