// From a client's picture to what a query or a row needs, on a pool of decoders.
//
// Errors  as ingest::Decoder.
// Threads from any thread; each call decodes on its own, no lock is held meanwhile.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "engine/image/signature.h"
#include "ingest/decode.h"
#include "schema/image_store.h"
#include "server/app/lending_pool.h"

namespace haarmony::server {

// What the transparent parts of a query mean.
enum class Mask {
    kAlpha,  // they do not count (the rule of make_signature, and of ingest)
    kNone,   // they are black, and count
};

class PictureReader {
  public:
    explicit PictureReader(const ingest::DecodeLimits& limits);

    [[nodiscard]] Result<image::Signature> signature(std::span<const std::uint8_t> bytes,
                                                     Mask mask);
    [[nodiscard]] Result<schema::NewImage> describe(std::span<const std::uint8_t> bytes);

  private:
    LendingPool<ingest::Decoder> decoders_;
};

// The signature of pixels that are already there: painted strokes.
[[nodiscard]] image::Signature signature_of_pixels(const ImageView& picture, Mask mask);

}  // namespace haarmony::server
