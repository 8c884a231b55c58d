// What a query is asked with: the signatures of its picture.
//
//   pixels, strokes, stored rows, signatures -> [query_picture] -> search_plan
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/image/signature.h"

namespace haarmony::server {

// What the transparent parts of a query mean.
enum class Mask {
    kAlpha,  // they do not count (the rule of make_signature, and of ingest)
    kNone,   // they are black, and count
};

// How the pixels of a query are looked at.
struct LookOptions {
    std::vector<image::SignatureKind> kinds = {{}};  // each once
    Mask mask = Mask::kAlpha;
    bool autocrop = false;       // without near-uniform borders
    bool partial = false;        // as a part of something larger (engine/image/window.h)
    bool misregistered = false;  // also a little moved and scaled (engine/image/window.h)
};

struct QueryPicture {
    // Of each kind one signature, or one for each window that the picture is placed at, the
    // whole canvas first, and one for each way that it may lie off.
    std::map<image::SignatureKind, std::vector<image::Signature>> signatures;
    std::optional<std::int32_t> log_aspect;  // unknown where only signatures are known
};

// Of pixels that are there: a decoded picture, painted strokes. `width` and `height` are
// those of the picture that the pixels show. Requires: both >= 1.
[[nodiscard]] QueryPicture look_at(const ImageView& pixels,
                                   int width,
                                   int height,
                                   const LookOptions& options);

}  // namespace haarmony::server
