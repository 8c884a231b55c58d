// Which encoding a client wants of a picture: the one that it names, or the best of those
// that its Accept header takes.
//
// Shape    of equally wanted ones the first of png, webp, jpeg, rgba; where it takes none of
//          them, png: a picture says more than a refusal.
// Source   RFC 9110, section 12.5.1.
#pragma once

#include <optional>
#include <string_view>

#include "server/api/inputs.h"
#include "server/app/video_picture.h"

namespace haarmony::server {

// "format" of the inputs, or by the header. Problems are left in `inputs`.
[[nodiscard]] PictureFormat read_picture_format(Inputs& inputs, std::string_view accept);

[[nodiscard]] PictureFormat accepted_format(std::string_view accept);

// "#rrggbb", the sign may be missing; opaque. Problems are left in `inputs`.
[[nodiscard]] std::optional<video::Rgba> read_background(Inputs& inputs);

}  // namespace haarmony::server
