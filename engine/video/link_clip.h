// Pass 2 of a build: the time nodes that were put aside, linked from the root down.
//   spooled_nodes.h, up_links.h -> [link_clip.h] -> build.h
//
// Errors   what the spool and the sink meet; kTooLarge (up_links.h); what `written` says.
// Cost     linear in what the spool holds.
// Memory   the layers of one way from the root to a leaf, and one exact frame.
// Threads  one caller.
// Source   sec. 5.3.1, Figure 5.7, MakeMRVideo(): preorder, so that links may lead to any
//          time-ancestor.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_spool.h"
#include "engine/video/layer.h"
#include "engine/video/spooled_nodes.h"

namespace haarmony::video {

struct LinkOptions {
    std::uint32_t delta = 0;                 // in units of difference()
    std::uint32_t max_index = kMaxRefIndex;  // of a node or brick in its layer
    // Frames of which a clip has all that they complete already: siblings below a time node
    // of these alone are left out.
    std::int64_t kept_frames = 0;
    // Told how many time nodes the sink has taken, after each pair of siblings; an error
    // ends the pass.
    std::function<Result<void>(std::int64_t nodes)> written = {};
};

// Calls sink.begin(), add() for all siblings that are stored, and finish().
// Requires: `nodes` has the time nodes of the shape that are not left out, their frames in
// `spool`.
[[nodiscard]] Result<void> link_clip(const ClipShape& shape,
                                     const SpooledNodes& nodes,
                                     FrameSpool& spool,
                                     ClipSink& sink,
                                     const LinkOptions& options);

}  // namespace haarmony::video
