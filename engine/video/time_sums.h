// The exact sums of the time nodes that are not complete yet, one a height, and every time
// node put aside as soon as it is.
//   exact_mean.h, frame_spool.h -> [time_sums.h] -> build.h
//
// Errors   what the spool meets.
// Cost     linear in the frames' detail; frames that follow upon an equal one are one run,
//          which costs what its logarithm many frames would.
// Memory   k + 2 sums for 2^k frames, two exact frames.
// Threads  one caller.
// Source   sec. 5.3.1, "a depth-first recursion"; DESIGN of the project, "File", pass 1.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/exact_mean.h"
#include "engine/video/frame_spool.h"
#include "engine/video/image_tree.h"
#include "engine/video/spooled_nodes.h"

namespace haarmony::video {

class TimeSums {
  public:
    // `spool` must outlive this.
    TimeSums(const FrameFormat& format, FrameSpool& spool)
        : format_(format), spool_(spool), sum_(format) {}

    // The next frames: `tree`, `repeats` times. Requires: repeats >= 1, and that all frames
    // are no more than ClipShape allows.
    [[nodiscard]] Result<void> add(const ImageTree& tree, std::int64_t repeats);
    // The next 2^height frames, by their sum; `uniform`: they are all the same. Time nodes
    // below theirs are not put aside.
    // Requires: sum.frames() is 2^height, of which frames() is a multiple.
    [[nodiscard]] Result<void> add_whole(int height, FrameSum sum, bool uniform);
    [[nodiscard]] std::int64_t frames() const { return frames_; }
    // All time nodes up to the root. Requires: frames() >= 1; nothing is added after.
    [[nodiscard]] Result<SpooledNodes> finish();

  private:
    // A complete node that waits for its brother.
    struct Waiting {
        FrameSum sum;
        SpooledNode node;
        bool present = false;
    };

    [[nodiscard]] Waiting& waiting(int height);
    // Puts the mean of sum_, equal frames, aside unless the last one was the same.
    [[nodiscard]] Result<void> spool_single();
    // Adds the node of that height that ends at frames_, its sum in sum_, and all that it
    // completes.
    [[nodiscard]] Result<void> complete(int height, SpooledNode node);
    // The node of both halves; the sum of the second, and then of the node, is in sum_.
    [[nodiscard]] Result<SpooledNode> join(Waiting& first, const SpooledNode& second);

    FrameFormat format_;
    FrameSpool& spool_;
    FrameSum sum_;                  // of the node at hand
    std::vector<Waiting> waiting_;  // by height
    std::int64_t frames_ = 0;
    SpooledNodes nodes_;
    ExactFrame exact_;
    ExactFrame last_;  // the single frame last put aside
    std::optional<SpooledFrame> last_spooled_;
};

}  // namespace haarmony::video
