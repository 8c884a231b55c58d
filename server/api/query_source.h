// What to search for: the one picture, signature, drawing or address that a query names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/core/ids.h"
#include "engine/image/signature.h"
#include "engine/image/strokes.h"
#include "server/api/context.h"
#include "server/api/inputs.h"
#include "server/api/outcome.h"
#include "server/app/picture_reader.h"

namespace haarmony::server {

struct SourceUrl {
    std::string url;
};

// Bytes of a picture that are the request's own, or were base64 in it.
using SourceBytes = std::variant<std::string_view, std::string>;

using QuerySource =
    std::variant<SourceBytes, ImageId, image::Signature, image::StrokePicture, SourceUrl>;

// Exactly one of: the picture in the body, "image", "id", "signature", "strokes", "url".
// 400 "no_source" or "several_sources" otherwise; problems with a value are left in
// `inputs`, and the source is absent then.
[[nodiscard]] std::optional<QuerySource> read_query_source(Inputs& inputs);

// The same for a picture that is to be stored: the body, "image" or "url".
[[nodiscard]] std::optional<std::variant<SourceBytes, SourceUrl>> read_picture_source(
    Inputs& inputs);

[[nodiscard]] std::span<const std::uint8_t> view_of(const SourceBytes& bytes);

}  // namespace haarmony::server
