#include "server/app/picture_reader.h"

#include <memory>

#include "ingest/describe.h"

namespace haarmony::server {

PictureReader::PictureReader(const ingest::DecodeLimits& limits)
    : decoders_([limits]() -> Result<std::unique_ptr<ingest::Decoder>> {
          return std::make_unique<ingest::Decoder>(limits);
      }) {}

Result<QueryPicture> PictureReader::look(std::span<const std::uint8_t> bytes,
                                         const LookOptions& options) {
    const auto decoder = decoders_.lend();
    if (!decoder) return decoder.error();
    const Result<ingest::Picture> picture = (*decoder)->decode(bytes);
    if (!picture) return picture.error();
    return look_at(picture->view(), picture->width, picture->height, options);
}

Result<schema::NewImage> PictureReader::describe(
    std::span<const std::uint8_t> bytes,
    std::span<const image::SignatureKind> kinds) {
    const auto decoder = decoders_.lend();
    if (!decoder) return decoder.error();
    return ingest::describe(**decoder, bytes, kinds);
}

}  // namespace haarmony::server
