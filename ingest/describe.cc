#include "ingest/describe.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "engine/image/signature_codec.h"
#include "ingest/thumbnail.h"

namespace haarmony::ingest {

Result<schema::NewImage> describe(Decoder& decoder, std::span<const std::uint8_t> bytes) {
    const Result<Picture> picture = decoder.decode(bytes);
    if (!picture) return picture.error();
    Result<std::vector<std::uint8_t>> thumbnail = make_thumbnail(picture->view());
    if (!thumbnail) return thumbnail.error();
    const image::Signature signature = image::make_signature(picture->view());

    schema::NewImage image;
    image.stamp.size = static_cast<std::int64_t>(bytes.size());
    image.stamp.content_hash = content_hash(bytes);
    image.width = picture->width;
    image.height = picture->height;
    image.media_type = picture->media_type;
    image.signature = image::encode_signature(signature);
    image.low_information = signature.low_information;
    image.thumbnail = {"image/jpeg", std::move(thumbnail).value()};
    return image;
}

Result<image::Signature> describe_query(Decoder& decoder,
                                        std::span<const std::uint8_t> bytes) {
    const Result<Picture> picture = decoder.decode(bytes);
    if (!picture) return picture.error();
    return image::make_signature(picture->view());
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
