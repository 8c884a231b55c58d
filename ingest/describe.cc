#include "ingest/describe.h"

#include <openssl/evp.h>

#include <array>
#include <cassert>
#include <optional>
#include <stdexcept>
#include <utility>

#include "engine/image/autocrop.h"
#include "engine/image/signature_codec.h"
#include "ingest/thumbnail.h"
#include "ingest/variant.h"

namespace haarmony::ingest {

namespace {

void append_named(std::span<const image::Signature> signatures,
                  Look look,
                  std::vector<schema::SignatureVariant>& variants) {
    for (const image::Signature& signature : signatures) {
        variants.push_back(
            {variant_name(signature.kind, look), image::encode_signature(signature)});
    }
}

// A second look at a picture that has borders.
void append_content(const ImageView& picture,
                    std::span<const image::SignatureKind> kinds,
                    std::vector<schema::SignatureVariant>& variants) {
    const std::optional<image::CropBox> box = image::content_box(picture);
    if (!box) return;
    const ImageView content = image::cropped(picture, *box);
    append_named(image::make_signatures(content, kinds), Look::kContent, variants);
}

}  // namespace

std::vector<schema::SignatureVariant> signature_variants(
    const ImageView& picture,
    std::span<const image::SignatureKind> kinds) {
    std::vector<schema::SignatureVariant> variants;
    append_named(image::make_signatures(picture, kinds), Look::kWhole, variants);
    append_content(picture, kinds, variants);
    return variants;
}

Result<schema::NewImage> describe(Decoder& decoder,
                                  std::span<const std::uint8_t> bytes,
                                  std::span<const image::SignatureKind> kinds) {
    assert(!kinds.empty() && kinds.front() == image::SignatureKind{});
    const Result<Picture> picture = decoder.decode(bytes);
    if (!picture) return picture.error();
    Result<std::vector<std::uint8_t>> thumbnail = make_thumbnail(picture->view());
    if (!thumbnail) return thumbnail.error();

    schema::NewImage image;
    image.stamp.size = static_cast<std::int64_t>(bytes.size());
    image.stamp.content_hash = content_hash(bytes);
    image.width = picture->width;
    image.height = picture->height;
    image.media_type = picture->media_type;
    const std::vector<image::Signature> signatures =
        image::make_signatures(picture->view(), kinds);
    image.signature = image::encode_signature(signatures.front());
    image.low_information = signatures.front().low_information;
    append_named(std::span(signatures).subspan(1), Look::kWhole, image.variants);
    append_content(picture->view(), kinds, image.variants);
    image.thumbnail = {"image/jpeg", std::move(thumbnail).value()};
    return image;
}

std::string content_hash(std::span<const std::uint8_t> bytes) {
    std::array<unsigned char, 32> digest{};
    // Fails only where memory is out or the library's configuration forbids SHA-256.
    if (EVP_Digest(
            bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr) !=
        1) {
        throw std::runtime_error("libcrypto refuses to compute SHA-256");
    }
    constexpr char kDigits[] = "0123456789abcdef";
    std::string hex;
    hex.reserve(2 * digest.size());
    for (const unsigned char byte : digest) {
        hex.push_back(kDigits[byte >> 4]);
        hex.push_back(kDigits[byte & 15]);
    }
    return hex;
}

}  // namespace haarmony::ingest
