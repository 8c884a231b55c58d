// One picture's bytes to everything that is stored of it (ingest, step 3 of 4):
//   walk -> decode -> [describe] -> store. The daemon uses the same function for uploads
// and queries, so that a picture always finds itself at distance 0.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/signature.h"
#include "ingest/decode.h"
#include "schema/image_store.h"

namespace haarmony::ingest {

// The kinds of a collection whose profiles are the built-in ones.
inline constexpr std::array<image::SignatureKind, 1> kMainKind{};

// Decodes, makes the signatures and the thumbnail, hashes the bytes. Fills everything but
// origin, uri, mtime, tags and metadata. Requires: `kinds` starts with the default kind.
[[nodiscard]] Result<schema::NewImage> describe(
    Decoder& decoder,
    std::span<const std::uint8_t> bytes,
    std::span<const image::SignatureKind> kinds);

// The same of pixels that are there, without what the bytes gave: media type, size and hash.
[[nodiscard]] Result<schema::NewImage> describe_pixels(
    const ImageView& picture,
    std::span<const image::SignatureKind> kinds);

// The signatures of one picture under their names (variant.h): those of `kinds`, in their
// order, and then those of what is within its borders, where it has borders.
[[nodiscard]] std::vector<schema::SignatureVariant> signature_variants(
    const ImageView& picture,
    std::span<const image::SignatureKind> kinds);

// Lower-case hex of SHA-256.
[[nodiscard]] std::string content_hash(std::span<const std::uint8_t> bytes);
// Of what a file holds, which need not fit in memory. kIo where it cannot be read;
// kUnavailable when `keep_going` says no.
[[nodiscard]] Result<std::string> content_hash(int file,
                                               const std::function<bool()>& keep_going);

}  // namespace haarmony::ingest
