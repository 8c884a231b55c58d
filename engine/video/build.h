// A clip from its frames: exact averages in time and space, pruning, up-links.
//   frame_source.h -> exact_mean.h -> [build.h] -> layer.h
//
// Pass 1 reads the source once, keeps the sums of the time nodes not yet complete (k + 1 of
// them) and puts every finished time node aside, exactly averaged. Pass 2 walks those from the
// root of the time tree and hands each pair of siblings to the sink: what a time-ancestor
// shows already is linked to it, the rest is its own.
//
// Guarantee  at delta 0 every pixel of every time node at every space level is the exact mean
//            of the source, rounded once, and linked content is byte-identical. At delta > 0
//            every such pixel is within delta (difference()) of that rounded mean, since
//            every prune and every link is tested against it.
// Errors     what the source, spool or sink meet; a clip outside ClipShape's limits; no frame
//            at all (kInvalidArgument, param frames); kUnavailable when `progress` says stop.
// Threads    one caller.
// Source     sec. 5.3.1, Figures 5.6, 5.7; ERRATA of the project, video 1 to 7, 12 to 17.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_source.h"
#include "engine/video/layer.h"
#include "engine/video/read_source.h"
#include "engine/video/spool.h"

namespace haarmony::video {

struct BuildOptions {
    std::uint32_t delta = 0;      // in units of difference()
    std::int64_t max_frames = 0;  // frames read at most; 0 = all
    BuildObserver progress = {};
};

// What was built. Returns after sink.finish().
[[nodiscard]] Result<ClipShape> build(FrameSource& source,
                                      Spool& spool,
                                      ClipSink& sink,
                                      const BuildOptions& options = {});

}  // namespace haarmony::video
