// A curve from a request, and in a reply.
//   Inputs -> [curve_json] -> curve_*.cc
//
// Shape    one of points (control points, or samples where no level has so many), samples (a
//          stroke) and d (SVG path data, of which subpath counts); closed, corners and
//          fit_tolerance beside it. What is no curve yet is fitted.
// Errors   400 for what has another type or contradicts; 422 naming it for what no curve can
//          have (points_json.h).
// Threads  values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/curve/fit.h"
#include "engine/curve/frame.h"
#include "engine/curve/level.h"
#include "engine/curve/points.h"
#include "server/api/inputs.h"
#include "server/api/json_text.h"
#include "server/api/points_json.h"

namespace haarmony::server {

inline constexpr std::size_t kMostPoints =
    curve::control_count(curve::kMostLevel, curve::Ends::kOpen);
inline constexpr std::size_t kMostSamples = 1'000'000;

// The members of a request: as Inputs::of_request(), 422 for a number that is not finite,
// and no picture.
[[nodiscard]] Outcome<Inputs> curve_inputs(const http::Request& request);

// The first problem but for names that nobody has asked for yet.
[[nodiscard]] std::optional<http::Problem> refused_so_far(const Inputs& inputs);

// What is said of a curve, not fitted yet.
struct CurveSource {
    enum class Kind { kControl, kSamples, kPath };
    Kind kind = Kind::kControl;
    curve::Points points;  // control points or samples
    std::string path;
    std::size_t subpath = 0;
    std::optional<bool> closed;
    std::optional<double> fit_tolerance;
    std::vector<double> corners;  // ascending
    bool detect_corners = false;
};

struct FitErrors {
    int level = 0;
    double max_error = 0;
    double rms_error = 0;
};

struct RequestedCurve {
    curve::Points control;
    curve::Ends ends = curve::Ends::kOpen;
    int level = 0;
    std::optional<FitErrors> fit;
    std::vector<double> corners;  // ascending, in (0, 1); of a closed curve in [0, 1)
};

// Asks `inputs` for all members of a curve. A name that nobody asked for is left to
// refused(), which should be looked at before anything is fitted.
[[nodiscard]] Outcome<CurveSource> read_curve_source(Inputs& inputs);

// A stroke to be fitted: samples with the path's drawn; closed if said so or the path is.
struct Stroke {
    curve::Points samples;
    curve::Ends ends = curve::Ends::kOpen;
    double deviation = 0;  // of a path from the chords between its samples
};
[[nodiscard]] Outcome<Stroke> stroke_of(CurveSource source);
// The same where a stroke is to be kept or compared: of control points, points of the curve.
[[nodiscard]] Outcome<Stroke> drawn_stroke_of(CurveSource source);

[[nodiscard]] Outcome<RequestedCurve> to_curve(CurveSource source);

// 1e-3 of the diagonal of the bounding box of x and y.
[[nodiscard]] double default_tolerance(const curve::Points& points);

[[nodiscard]] std::optional<curve::Frame> read_frame(Inputs& inputs);
// A real number of any size: what bounds it is said in a 422 later.
[[nodiscard]] std::optional<double> read_real(Inputs& inputs, std::string_view name);
// A whole number, written with or without a fraction of 0.
[[nodiscard]] std::optional<double> read_whole(Inputs& inputs, std::string_view name);

// 422 unless 0 <= level <= most.
[[nodiscard]] std::optional<http::Problem> refuse_level(std::string_view name,
                                                        double level,
                                                        int most);

// The members "points", "level" and, where they are so, "closed", "fit".
void add_curve(JsonObject& object,
               const curve::Points& control,
               int level,
               const RequestedCurve& asked);
void add_fit(JsonObject& object, const std::optional<FitErrors>& fit);

}  // namespace haarmony::server
