#include <memory>
#include <utility>

#include "ingest/decode.h"
#include "ingest/describe.h"
#include "ingest/pipeline.h"

namespace haarmony::ingest {

MakePictureSteps picture_steps(std::vector<image::SignatureKind> kinds) {
    return [kinds = std::move(kinds)]() -> PictureSteps {
        const auto decoder = std::make_shared<Decoder>(DecodeLimits{});
        return {[decoder, kinds](std::span<const std::uint8_t> bytes) {
                    return describe(*decoder, bytes, kinds);
                },
                content_hash};
    };
}

}  // namespace haarmony::ingest
