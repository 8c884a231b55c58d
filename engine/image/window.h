// A query that shows only a part of what is looked for, tried as several parts (image search,
// before step 0 of 5):
//   [window.h] -> resample.h, mask.h -> ... -> query.h -> best_of.h
//
// The picture is placed at several windows of a larger canvas on which nothing else is
// painted (mask.h); each placement is searched by itself and a match counts at its best.
//
// Units   per cent of the canvas.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.6, "Affine transformation and partial queries"; sec. 4.5, "slightly
//         misregistered".
#pragma once

#include <span>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/image/query.h"
#include "engine/image/signature.h"

namespace haarmony::image {

struct Placement {
    int left = 0;
    int top = 0;
    int side = 100;
    friend bool operator==(const Placement&, const Placement&) = default;
};

// The whole canvas first; 80 % of each side in the corners and the middle; 60 % in the middle
// and at 4 x 4 places. What lies between is near enough to one of them.
[[nodiscard]] std::span<const Placement> placements();

struct WindowSignature {
    Placement placement;
    Signature signature;
};

// One for each of placements(); the first is make_signature(picture, kind).
// Requires: as there. Cost: one pass over the pixels for each, the others than the first on
// 192 x 192 samples of the picture.
[[nodiscard]] std::vector<WindowSignature> window_signatures(const ImageView& picture,
                                                             const SignatureKind& kind);

// A query that lies a little off what is looked for, as a scan does: moved by one fiftieth of
// a side in eight directions, what is missing a repetition of the edge, and a twentieth
// smaller and larger; not as it is. Requires: as for make_signature(). Cost: as above.
[[nodiscard]] std::vector<Signature> moved_signatures(const ImageView& picture,
                                                      const SignatureKind& kind);

// The query with all its weights times weight_sum / query.weight_sum, rounded: placements
// have different numbers of coefficients, and only so can distances under them be compared.
// A query without coefficients stays as it is. Requires: weight_sum >= 0.
[[nodiscard]] Query with_weight_sum(const Query& query, std::int64_t weight_sum);

}  // namespace haarmony::image
