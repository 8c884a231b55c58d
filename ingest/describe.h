// One picture's bytes to everything that is stored of it (ingest, step 3 of 4):
//   walk -> decode -> [describe] -> store. The daemon uses the same function for uploads
// and queries, so that a picture always finds itself at distance 0.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/image/signature.h"
#include "ingest/decode.h"
#include "schema/image_store.h"

namespace haarmony::ingest {

// Decodes, makes signature and thumbnail, hashes the bytes. Fills everything but origin,
// uri, mtime, tags and metadata.
[[nodiscard]] Result<schema::NewImage> describe(Decoder& decoder,
                                                std::span<const std::uint8_t> bytes);

// Only the signature: what a query needs.
[[nodiscard]] Result<image::Signature> describe_query(
    Decoder& decoder,
    std::span<const std::uint8_t> bytes);

// Lower-case hex of SHA-256.
[[nodiscard]] std::string content_hash(std::span<const std::uint8_t> bytes);

}  // namespace haarmony::ingest
