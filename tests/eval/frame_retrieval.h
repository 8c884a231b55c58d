// Whether frames of clips that come back poor find their own shot first: 100 of them, drawn by
// lot from all clips, in as many ways of being poor as distortions.h knows.
//   frame_collection.h, distortions.h -> [frame_retrieval.h]
//
// Each is asked as it is, and with the option `misregistered`. Two collections: every clip a
// video of its own, and all clips one after the other in a single film, whose cuts are known.
// A query is made from the frame as it is in its file; what is found first counts as its own
// shot if it is of the same video and shot.
//
// Errors  of the folder and of its clips, by name; a folder without any clip is kNotFound; an
//         unknown profile is kInvalidArgument.
// Source  sec. 6.3, "Searching inside video"; sec. 4.5, scanned and painted queries.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "tests/eval/figures.h"
#include "tests/eval/video_clips.h"

namespace haarmony::eval {

struct FrameRetrievalOptions {
    std::string clips = {};     // the folder
    int queries = 100;          // frames drawn by lot
    std::int64_t frames = 256;  // of each clip, the first ones
    // Of the frames as they are indexed, the longer one, in pixels. With a power of two
    // fewer of them space level 7 shows the same, and all clips fit in memory.
    std::int32_t side = 320;
    std::uint64_t seed = 1;
    std::vector<std::string> profiles = {"painted", "scanned"};
};

struct FrameRetrievalRow {
    std::string collection;  // "clips", "one film"
    std::string distortion;
    std::string profile;
    bool misregistered = false;  // asked with that option
    int queries = 0;
    int own_shot = 0;  // found first
    int own_clip = 0;

    friend bool operator==(const FrameRetrievalRow&, const FrameRetrievalRow&) = default;
};

struct FrameRetrieval {
    std::int64_t clips = 0;
    std::int64_t frames = 0;
    std::int64_t signatures = 0;  // of the clips
    std::int64_t clip_shots = 0;  // found in them
    std::int64_t film_shots = 0;  // found in the film
    std::int64_t film_cuts = 0;   // of the film where a shot begins
    std::vector<FrameRetrievalRow> rows;

    // Of a distortion, under a profile, in the collection named; asked without options.
    [[nodiscard]] const FrameRetrievalRow& row(const std::string& collection,
                                               const std::string& distortion,
                                               const std::string& profile) const;
};

// The same of clips that are at hand. Requires: at least one, each with frames.
[[nodiscard]] Result<FrameRetrieval> measure_frames(
    const std::vector<VideoClip>& clips,
    const FrameRetrievalOptions& options,
    const std::function<void(const std::string&)>& progress);

[[nodiscard]] Result<FrameRetrieval> measure_frames(
    const FrameRetrievalOptions& options,
    const std::function<void(const std::string&)>& progress);

[[nodiscard]] std::string to_text(const FrameRetrieval& measured);
// frame_retrieval.csv
[[nodiscard]] std::vector<OutputFile> frame_retrieval_files(
    const FrameRetrieval& measured);

}  // namespace haarmony::eval
