// A clip from pictures in files of their own: 0001.png, 0002.png, ...
// (video, step 1): files -> decode.h -> [picture_sequence.h] -> PictureFrameSource.
//
// Shape   as video_source.h; each file is one frame, and all have the size of the first.
//         Pictures are decoded as all others are (decode.h): upright, and in the child where
//         their format asks for it. JPEGs keep their size.
// Errors  those of decode.h and read_file.h, with the file's name (not its folder) in front;
//         kInvalidArgument: no files, a picture of another size, a rate that is not positive.
// Threads one caller a sequence.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "ingest/decode.h"
#include "ingest/picture_source.h"

namespace haarmony::ingest {

struct PictureSequenceOptions {
    std::vector<std::string> files;  // absolute paths
    video::FrameRate rate = {25, 1};
    std::int64_t max_file_bytes = std::int64_t{1} << 28;
    DecodeLimits limits = {};
};

// The first picture is decoded here, for its size.
[[nodiscard]] Result<std::unique_ptr<PictureSource>> open_picture_sequence(
    PictureSequenceOptions options);

// The files of a folder whose names end as those of pictures do, in the order of their names,
// in which numbers count as numbers: 2.png before 10.png. Folders within are left out.
// kNotFound, kIo.
[[nodiscard]] Result<std::vector<std::string>> pictures_in(const std::string& folder);

}  // namespace haarmony::ingest
