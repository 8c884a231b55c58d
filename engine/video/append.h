// Frames put behind the last one of a clip, which stays as it is.
//   time_tree.h, frame_source.h -> [append.h] -> mrv_writer.h
//
// A time node of old frames alone is complete and shows what it showed, with all that is below
// it. New are the time nodes of the new frames, and those on the way to them from the root,
// whose averages change. Pass 1 adds up the old frames, read from the clip, and the new ones;
// pass 2 hands the sink all siblings below a time node that the new frames change or make.
//
// Guarantee  every time node at every space level and edge is byte for byte what build() makes
//            of all frames.
// Errors     what clip, source, spool or sink meet; a source of another size or rate
//            (kInvalidArgument, naming both); no frame at all; a clip outside ClipShape's
//            limits; kUnavailable when `progress` says stop. kConflict: a clip of delta > 0,
//            whose frames are not those of its source, so that errors could add up.
// Cost       reads n old frames; writes for m new ones O(m + log n) time nodes.
// Threads    one caller.
// Source     sec. 5.3.1, Figures 5.6, 5.7, for a clip that goes on.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/layer.h"
#include "engine/video/read_source.h"
#include "engine/video/spool.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

struct AppendOptions {
    std::int64_t max_frames = 0;  // new frames read at most; 0 = all
    // Old frames count among those read.
    BuildObserver progress = {};
};

// Whether frames of one format can follow upon those of a clip: kInvalidArgument naming both
// and, as param, what differs: width, height or rate.
[[nodiscard]] Result<void> can_follow(const FrameFormat& more, const FrameFormat& clip);

// What the clip has become. Returns after sink.finish().
[[nodiscard]] Result<ClipShape> append(const TimeTree& clip,
                                       FrameSource& more,
                                       Spool& spool,
                                       ClipSink& sink,
                                       const AppendOptions& options = {});

}  // namespace haarmony::video
