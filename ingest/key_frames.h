// The key frames of a film, each described as a picture (ingest, steps 2 and 3 of 4):
//   video_source.h -> [key_frames] -> film_rows.h
//
// Of a film with more of them than are wanted, every second, fourth, eighth ... is taken: so
// at least half as many as are wanted, evenly spaced, in one pass and in memory for those
// that stay. Two within the same millisecond are one.
//
// Errors  those of the source and of `describe`; kUnavailable when `keep_going` says no.
// Threads one caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/core/result.h"
#include "ingest/picture_source.h"
#include "schema/image_store.h"

namespace haarmony::ingest {

struct KeyFrame {
    std::int64_t time_us = 0;  // when it is first shown, >= 0
    std::int64_t number = 0;   // which frame that is at the film's average rate, from 0
    schema::NewImage image;    // what its pixels give
};

// A film with a key frame every ten seconds has fewer in an hour and a quarter.
inline constexpr std::size_t kMostKeyFrames = 500;
// More cannot be asked for.
inline constexpr int kLargestMostKeyFrames = 100'000;

// Requires: `pictures` shows key frames alone; most >= 1.
[[nodiscard]] Result<std::vector<KeyFrame>> describe_key_frames(
    PictureSource& pictures,
    std::size_t most,
    const std::function<Result<schema::NewImage>(const ImageView&)>& describe,
    const std::function<bool()>& keep_going);

}  // namespace haarmony::ingest
