// A curve with corners from a request, and in a reply: pieces between the corners.
//   Inputs -> curve_json.h -> [cornered_json] -> curve_*.cc
//
// Shape    beside points and level, which are one curve that rounds the corners off within
//          the tolerance, a reply has the corners and the pieces themselves.
// Errors   as curve_json.h; 422 naming corners that cannot be.
// Threads  values.
#pragma once

#include <optional>
#include <string>

#include "engine/curve/cornered_curve.h"
#include "server/api/curve_json.h"

namespace haarmony::server {

struct CorneredRequest {
    curve::CorneredCurve curve;
    int level = 0;         // of the whole curve, or of the finest fitted piece
    double tolerance = 0;  // of what is fitted: pieces, and the one curve of a reply
    std::optional<FitErrors> fit;
};

[[nodiscard]] bool has_corners(const CurveSource& source);

// Requires: has_corners(source).
[[nodiscard]] Outcome<CorneredRequest> to_cornered(CurveSource source);
// A stroke's pieces, all of this level, or of the smallest within the tolerance.
[[nodiscard]] Outcome<CorneredRequest> fit_pieces(const CurveSource& source,
                                                  const Stroke& stroke,
                                                  const curve::PieceGoal& goal,
                                                  const curve::FitOptions& options);

// One curve without corners, for what is of a whole curve alone: as to_curve(), but where
// pieces are fitted, these with the corners rounded off within the tolerance.
struct RoundedRequest {
    RequestedCurve curve;  // `corners` are those that were found, or said
    double rounding_error = 0;
};
[[nodiscard]] Outcome<RoundedRequest> to_rounded(CurveSource source);

[[nodiscard]] int level_of_piece(const curve::CorneredCurve& curve, std::size_t piece);

// The members "points", "level", "corners", "pieces", "rounding_error" and, where they are
// so, "closed" and "fit".
void add_cornered(JsonObject& object,
                  const curve::CorneredCurve& curve,
                  const CorneredRequest& asked);

}  // namespace haarmony::server
