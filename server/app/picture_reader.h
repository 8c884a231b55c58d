// From a client's picture to what a query or a row needs, on a pool of decoders.
//
// Errors  as ingest::Decoder.
// Threads from any thread; each call decodes on its own, no lock is held meanwhile.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "engine/image/signature_kind.h"
#include "ingest/decode.h"
#include "schema/image_store.h"
#include "server/app/lending_pool.h"
#include "server/app/query_picture.h"

namespace haarmony::server {

class PictureReader {
  public:
    explicit PictureReader(const ingest::DecodeLimits& limits);

    [[nodiscard]] Result<QueryPicture> look(std::span<const std::uint8_t> bytes,
                                            const LookOptions& options);
    // Requires: `kinds` starts with the default kind.
    [[nodiscard]] Result<schema::NewImage> describe(
        std::span<const std::uint8_t> bytes,
        std::span<const image::SignatureKind> kinds);

  private:
    LendingPool<ingest::Decoder> decoders_;
};

}  // namespace haarmony::server
