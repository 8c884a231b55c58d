// Pass 1 of a build: the frames of a source added up.
//   frame_source.h, time_sums.h -> [read_source.h] -> build.h, append.h
//
// Frames like the one before are added with it.
//
// Errors   what the source or the spool meets; frames beyond ClipShape's limits; no frame at
//          all (kInvalidArgument, param frames); kUnavailable when `told` says stop.
// Threads  one caller.
#pragma once

#include <cstdint>
#include <functional>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/time_sums.h"

namespace haarmony::video {

// How many frames are read (pass 1) and how many time nodes are written (pass 2); false stops
// the build.
using BuildObserver =
    std::function<bool(std::int64_t frames_read, std::int64_t nodes_written)>;

// How far a build has come, told to whom it concerns.
struct BuildProgress {
    const BuildObserver& told;
    std::int64_t frames_read = 0;
    std::int64_t nodes_written = 0;

    [[nodiscard]] Result<void> tell() const;
};

// All frames, or `most` unless that is 0, behind those that `sums` has; frames_read counts on.
[[nodiscard]] Result<void> read_source(FrameSource& source,
                                       std::int64_t most,
                                       TimeSums& sums,
                                       BuildProgress& progress);

}  // namespace haarmony::video
