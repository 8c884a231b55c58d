// A curve through a drawn stroke, within a tolerance or of a level.
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "engine/curve/svg_path.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_json.h"
#include "server/api/curves.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

constexpr std::array<std::string_view, 2> kSpacings{"chord_length", "centripetal"};

struct FitRequest {
    std::optional<double> tolerance;
    std::optional<double> level;
    curve::FitOptions options;
};

Outcome<FitRequest> read_fit(Inputs& inputs) {
    FitRequest fit;
    fit.tolerance = inputs.number("tolerance", 0, curve::kMostPathCoordinate);
    if (fit.tolerance && *fit.tolerance == 0)
        inputs.refuse("tolerance", "is not above 0");
    fit.level = read_whole(inputs, "level");
    if (inputs.one_of("spacing", kSpacings) == kSpacings[1])
        fit.options.spacing = curve::Spacing::kCentripetal;
    fit.options.pin_ends = inputs.boolean("pin_ends").value_or(false);
    if (fit.level && (fit.tolerance || inputs.has("fit_tolerance")))
        inputs.refuse("level", "is given together with a tolerance");
    if (fit.tolerance && inputs.has("fit_tolerance"))
        inputs.refuse("fit_tolerance", "is given together with tolerance");
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);
    return fit;
}

std::optional<http::Problem> refuse_fit_level(double level, curve::Ends ends) {
    const int least = ends == curve::Ends::kClosed ? curve::kLeastClosedFitLevel : 0;
    if (level >= least && level <= curve::kMostFitLevel) return {};
    return impossible("level_out_of_range",
                      "level '" + number_text(level) + "' is not from " +
                          std::to_string(least) + " to " +
                          std::to_string(curve::kMostFitLevel),
                      "level");
}

}  // namespace

Reply post_fit(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto fit = read_fit(*inputs);
    if (!fit) return fit.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    const std::optional<double> tolerance =
        fit->tolerance ? fit->tolerance : source->fit_tolerance;
    source->fit_tolerance = tolerance;
    auto stroke = stroke_of(*source);
    if (!stroke) return stroke.problem();
    fit->options.ends = stroke->ends;
    if (fit->level) {
        if (auto problem = refuse_fit_level(*fit->level, stroke->ends))
            return *std::move(problem);
    }
    const double within = tolerance.value_or(default_tolerance(stroke->samples));
    if (has_corners(*source)) {
        curve::PieceGoal goal;
        if (fit->level) goal.level = static_cast<int>(*fit->level);
        goal.tolerance = within;
        auto pieces = fit_pieces(*source, *stroke, goal, fit->options);
        if (!pieces) return pieces.problem();
        std::string text;
        JsonObject reply(text);
        add_cornered(reply, pieces->curve, *pieces);
        reply.end();
        return http::json_text_response(200, std::move(text));
    }
    const curve::CurveFit fitted =
        fit->level
            ? curve::fit(stroke->samples, static_cast<int>(*fit->level), fit->options)
            : curve::fit_within(stroke->samples, within, fit->options);

    std::string text;
    JsonObject reply(text);
    RequestedCurve asked;
    asked.ends = stroke->ends;
    asked.fit = FitErrors{fitted.level, fitted.max_error, fitted.rms_error};
    add_curve(reply, fitted.control, fitted.level, asked);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
