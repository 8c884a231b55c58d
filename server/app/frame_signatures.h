// What a search inside a video finds: the signatures of its frames and of the stretches of
// frames that the time tree has averaged already, and the shots that they belong to.
//
//   video_build -> [frame_signatures] -> schema/video_store, frame_search
//
// The pictures are those of space level kSignatureLevel, where a root square has the 128 x 128
// cells of a signature: nothing finer is read or decoded. Time nodes that are not stored look
// like their ancestors and have no signature of their own.
//
// Shots    a new one begins with a frame that differs from the one before by more than
//          kShotDifference and more than kShotFactor times what the last differences were on
//          average. A stretch of frames has a signature only if it lies within one shot: the
//          average of two shots shows neither.
// Errors   what the storage meets; kUnavailable when `go_on` says stop.
// Threads  one caller.
// Source   sec. 6.3, "Searching inside video"; sec. 4.3.1.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/picture.h"
#include "engine/video/time_tree.h"
#include "schema/video_store.h"

namespace haarmony::server {

inline constexpr int kSignatureLevel = 7;

inline constexpr double kShotDifference = 16;  // grey levels, mean over the picture
inline constexpr double kShotFactor = 3;
inline constexpr int kShotMemory = 8;  // how many differences are the last ones

// Mean absolute difference of luminance in grey levels, premultiplied: what is clear in both
// does not differ. Requires: pictures of one size.
[[nodiscard]] double mean_difference(const video::Picture& a, const video::Picture& b);

// Which shot each frame belongs to, from 0. differences[i] is that of frame i + 1 from frame i.
[[nodiscard]] std::vector<std::int64_t> shots_of(const std::vector<double>& differences);

// Which shot each frame of a clip belongs to.
[[nodiscard]] Result<std::vector<std::int64_t>> find_shots(
    const video::TimeTree& clip,
    const std::function<bool()>& go_on);

// Without those of the halves of time nodes that are complete in the first `kept_frames`:
// appended frames change nothing of these. Shots of old frames stay what they were, too.
[[nodiscard]] Result<std::vector<schema::FrameSignature>> frame_signatures(
    const video::TimeTree& clip,
    std::int64_t kept_frames,
    const std::function<bool()>& go_on);

}  // namespace haarmony::server
