// The pictures of a clip, decoded by libav; in the child alone
// (video): file -> [libav_source.h] -> libav_pixels.h, display_matrix.h -> the parent.
//
// libav sees one file through our own reads, the demuxer that the first bytes ask for, and
// decoders of a list: no network, no playlists, no second file. One thread, so that the same
// bytes give the same pictures whatever is wrong with them.
//
// Shape   as video_source.h. VP8 and VP9 with alpha are read by libvpx, since libav's own
//         decoders leave alpha out. A PNG with animation chunks is read as APNG.
// Errors  kUnsupportedFormat (no video in it, a codec not on the list), kUndecodable (what
//         libav cannot read or says that it conceals; a cut animation; a size that
//         changes), kTooLarge. Of a film that is cut between two packets, what there is.
// Threads one caller a source.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/result.h"
#include "ingest/picture_source.h"
#include "ingest/video_format.h"
#include "ingest/video_wire.h"

namespace haarmony::ingest {

struct LibavSourceOptions {
    VideoFormat format = VideoFormat::kMp4;
    VideoFrames frames = VideoFrames::kAll;
    std::int64_t max_pixels = 0;
};

// Requires: `file` is a regular file, open while the source lives; format is not kWebp.
[[nodiscard]] Result<std::unique_ptr<PictureSource>> open_libav_source(
    int file,
    const LibavSourceOptions& options);

}  // namespace haarmony::ingest
