// Frames of an encoded film by number, decoded and scaled by libav: what a player that jumps
// does, less the container.
//   video_encoder.h -> [video_decoder.h] -> video_speed.h
//
// Errors  kUnavailable: this libav lacks the decoder; kUndecodable: what it cannot read.
// Cost    from the last key frame before the first one asked for; no packet more than needed.
// Threads one; one caller a decoder.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/core/result.h"
#include "engine/video/picture.h"
#include "tests/eval/video_encoder.h"

namespace haarmony::eval {

class FilmDecoder {
  public:
    // Frames are scaled to width x height by averaging. `film` must outlive the decoder.
    [[nodiscard]] static Result<std::unique_ptr<FilmDecoder>>
    open(const EncodedFilm& film, std::int32_t width, std::int32_t height);
    ~FilmDecoder();

    // Each of `count` frames from `first` on, in their order, decoded into the same picture.
    // Requires: frames that the film has.
    [[nodiscard]] Result<void> frames(
        std::int64_t first,
        std::int64_t count,
        const std::function<void(const video::Picture&)>& visit);

  private:
    class Impl;
    explicit FilmDecoder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::eval
