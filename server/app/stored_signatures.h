// The signatures of a picture as the database has them, decoded one by one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "engine/core/result.h"
#include "engine/image/aspect.h"
#include "engine/image/signature_codec.h"
#include "ingest/variant.h"
#include "schema/image_store.h"

namespace haarmony::server {

[[nodiscard]] inline std::int32_t log_aspect_of(const schema::SearchableImage& image) {
    // No picture has a side of 0, but a row that others wrote may.
    return image::log_aspect(std::max(1, image.width), std::max(1, image.height));
}

// Calls sound(variant, signature) for each, the first one being of kMainVariant, and
// damaged(reason) for each that is no signature.
template <typename Sound, typename Damaged>
void decode_signatures(const schema::SearchableImage& image,
                       const Sound& sound,
                       const Damaged& damaged) {
    const auto decode = [&](const std::string& variant,
                            std::span<const std::uint8_t> bytes) {
        Result<image::Signature> signature = image::decode_signature(bytes);
        if (signature) return sound(variant, std::move(signature).value());
        damaged(variant + ": " + signature.error().message);
    };
    static const std::string main_variant(ingest::kMainVariant);
    decode(main_variant, image.signature);
    for (const schema::SignatureVariant& variant : image.variants)
        decode(variant.variant, variant.signature);
}

}  // namespace haarmony::server
