#include <memory>

#include "ingest/decode.h"
#include "ingest/describe.h"
#include "ingest/pipeline.h"

namespace haarmony::ingest {

PictureSteps make_picture_steps() {
    const auto decoder = std::make_shared<Decoder>(DecodeLimits{});
    return {[decoder](std::span<const std::uint8_t> bytes) {
                return describe(*decoder, bytes);
            },
            content_hash};
}

}  // namespace haarmony::ingest
