// Where the exact frame of every time node waits between the two passes of a build.
//   frame_spool.h -> [spooled_nodes.h] -> time_sums.h, build.h
//
// Shape    a node of height h covers the frames [i 2^h, (i + 1) 2^h) that exist: heights
//          count from single frames up, because how many time levels there will be is not
//          known before the source ends. Nodes below one whose frames are all the same are
//          not kept.
// Errors   none.
// Threads  one caller while nodes are added; const-thread-safe after.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/frame_spool.h"

namespace haarmony::video {

struct SpooledNode {
    SpooledFrame frame;
    bool uniform = false;  // all frames that it covers are this one
};

class SpooledNodes {
  public:
    // Requires: indices of one height ascend; a node comes after those below it.
    void add(int height, std::int64_t index, const SpooledNode& node);
    // Requires: the node was added, and none above it is uniform.
    [[nodiscard]] const SpooledNode& at(int height, std::int64_t index) const;
    // How many are kept.
    [[nodiscard]] std::size_t size() const;

  private:
    struct Row {
        std::int64_t index = 0;
        SpooledNode node;
    };
    std::vector<std::vector<Row>> rows_;  // by height
};

}  // namespace haarmony::video
