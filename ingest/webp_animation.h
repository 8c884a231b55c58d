// The pictures of a WebP file, still or animated, with libwebp; in the child alone
// (video): bytes -> [webp_animation.h] -> the parent. libav does not read animated WebP.
//
// Shape   the whole canvas each time, frames blended and disposed of; what none of them
//         covers is clear (the file's background colour is a hint that no browser takes).
//         Rate: frames over their durations together; 10 a second where they have none.
//         Every frame counts as a key frame: none needs another to be decoded.
// Errors  kUndecodable, kTooLarge (names pixels and limit).
// Threads one caller a source.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/core/result.h"
#include "ingest/picture_source.h"

namespace haarmony::ingest {

// Requires: `bytes` stay as they are while the source lives.
[[nodiscard]] Result<std::unique_ptr<PictureSource>> open_webp_animation(
    std::span<const std::uint8_t> bytes,
    std::int64_t max_pixels);

}  // namespace haarmony::ingest
