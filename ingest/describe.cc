#include "ingest/describe.h"

#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "engine/image/autocrop.h"
#include "engine/image/signature_codec.h"
#include "ingest/thumbnail.h"
#include "ingest/variant.h"

namespace haarmony::ingest {

namespace {

constexpr std::size_t kHashedAtOnce = std::size_t{1} << 20;

class Sha256 {
  public:
    Sha256() : context_(EVP_MD_CTX_new()) {
        check(context_ ? EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) : 0);
    }
    void add(std::span<const std::uint8_t> bytes) {
        check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
    }
    // Ends it.
    std::string hexadecimal() {
        std::array<unsigned char, 32> digest{};
        check(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr));
        constexpr char kDigits[] = "0123456789abcdef";
        std::string hex;
        hex.reserve(2 * digest.size());
        for (const unsigned char byte : digest) {
            hex.push_back(kDigits[byte >> 4]);
            hex.push_back(kDigits[byte & 15]);
        }
        return hex;
    }

  private:
    // Fails only where memory is out or the library's configuration forbids SHA-256.
    static void check(int done) {
        if (done != 1) throw std::runtime_error("libcrypto refuses to compute SHA-256");
    }
    struct Free {
        void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    };
    std::unique_ptr<EVP_MD_CTX, Free> context_;
};

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

Result<schema::NewImage> describe_pixels(const ImageView& picture,
                                         std::span<const image::SignatureKind> kinds) {
    assert(!kinds.empty() && kinds.front() == image::SignatureKind{});
    Result<std::vector<std::uint8_t>> thumbnail = make_thumbnail(picture);
    if (!thumbnail) return thumbnail.error();
    schema::NewImage image;
    image.width = picture.width;
    image.height = picture.height;
    const std::vector<image::Signature> signatures =
        image::make_signatures(picture, kinds);
    image.signature = image::encode_signature(signatures.front());
    image.low_information = signatures.front().low_information;
    append_named(std::span(signatures).subspan(1), Look::kWhole, image.variants);
    append_content(picture, kinds, image.variants);
    image.thumbnail = {"image/jpeg", std::move(thumbnail).value()};
    return image;
}

Result<schema::NewImage> describe(Decoder& decoder,
                                  std::span<const std::uint8_t> bytes,
                                  std::span<const image::SignatureKind> kinds) {
    const Result<Picture> picture = decoder.decode(bytes);
    if (!picture) return picture.error();
    Result<schema::NewImage> image = describe_pixels(picture->view(), kinds);
    if (!image) return image;
    image->stamp.size = static_cast<std::int64_t>(bytes.size());
    image->stamp.content_hash = content_hash(bytes);
    // Pixels may be scaled down.
    image->width = picture->width;
    image->height = picture->height;
    image->media_type = picture->media_type;
    return image;
}

std::string content_hash(std::span<const std::uint8_t> bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.hexadecimal();
}

Result<std::string> content_hash(int file, const std::function<bool()>& keep_going) {
    Sha256 hash;
    std::vector<std::uint8_t> piece(kHashedAtOnce);
    for (off_t offset = 0;;) {
        if (!keep_going()) return Error{ErrorCode::kUnavailable, "was stopped"};
        const ssize_t count = ::pread(file, piece.data(), piece.size(), offset);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0)
            return Error{ErrorCode::kIo, std::generic_category().message(errno)};
        if (count == 0) return hash.hexadecimal();
        hash.add(std::span(piece).first(static_cast<std::size_t>(count)));
        offset += count;
    }
}

}  // namespace haarmony::ingest
