// Editing the sweep of a curve, by a control point or by a point of the curve.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/curve/affected.h"
#include "engine/curve/bspline.h"
#include "engine/curve/direct_edit.h"
#include "engine/curve/portion.h"
#include "engine/curve/smooth.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_edit_json.h"
#include "server/api/curves.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

http::Problem no_index(double index, int level, std::size_t count) {
    return impossible("out_of_range",
                      "control.index '" + number_text(index) + "' is not from 0 to " +
                          std::to_string(count - 1) + ", as level " +
                          std::to_string(level) + " has it",
                      "control.index");
}

// The level that moves the portion, where the curve is pulled.
Outcome<double> level_of_portion(const EditRequest& edit, const RequestedCurve& asked) {
    const curve::PortionLengths lengths(asked.control, asked.ends);
    const double portion =
        edit.fraction ? *edit.portion * lengths.total() : *edit.portion;
    if (!(portion > 0)) return 0.0;  // of a curve without length
    const Pulled& pulled = edit.pulled;
    if (!pulled.index) {
        const double u =
            pulled.u ? *pulled.u
                     : curve::nearest(
                           asked.control, asked.ends, pulled.near[0], pulled.near[1]);
        return lengths.level_for(u, portion);
    }
    const double most = static_cast<double>(asked.control.size());
    const auto level =
        *pulled.index >= 0 && *pulled.index < most
            ? lengths.level_for_control(static_cast<std::size_t>(*pulled.index), portion)
            : std::nullopt;
    if (!level) return no_index(*pulled.index, asked.level, asked.control.size());
    return *level;
}

std::optional<http::Problem> refuse_pulled(const Pulled& pulled,
                                           const RequestedCurve& asked) {
    const std::string name = pulled.index ? "control" : "point";
    const int dimension = asked.control.dimension();
    if (pulled.delta.size() != static_cast<std::size_t>(dimension))
        return impossible("mixed_dimensions",
                          name + ".delta has " + std::to_string(pulled.delta.size()) +
                              " numbers, the points have " + std::to_string(dimension),
                          name + ".delta");
    if (pulled.u && !(*pulled.u >= 0 && *pulled.u <= 1))
        return impossible(
            "out_of_range",
            "point.u '" + number_text(*pulled.u) + "' is not a parameter from 0 to 1",
            "point.u");
    if (!pulled.near.empty() && dimension < 2)
        return impossible("dimension_out_of_range",
                          "point.near needs a curve with x and y, this has one number",
                          "point.near");
    return {};
}

Outcome<curve::Edited> edited(const EditRequest& edit,
                              const RequestedCurve& asked,
                              double level) {
    const curve::MultiresCurve whole = curve::decompose(asked.control, asked.ends);
    const Pulled& pulled = edit.pulled;
    if (pulled.index) {
        const int controls = curve::RealLevel(level).ceil();
        const std::size_t count = curve::control_count(controls, asked.ends);
        if (!(*pulled.index >= 0 && *pulled.index < static_cast<double>(count)))
            return no_index(*pulled.index, controls, count);
        curve::ControlEdit change;
        change.level = level;
        change.index = static_cast<std::size_t>(*pulled.index);
        change.delta = pulled.delta;
        change.frame = edit.frame;
        auto moved = curve::edit_sweep(whole, change);
        if (!moved) return impossible(moved.error());
        return std::move(moved).value();
    }
    curve::PointEdit change;
    change.level = level;
    change.delta = pulled.delta;
    change.drag = edit.drag;
    change.frame = edit.frame;
    if (pulled.u) {
        change.u = *pulled.u;
    } else if (edit.drag == curve::Drag::kFull) {
        change.u =
            curve::nearest(asked.control, asked.ends, pulled.near[0], pulled.near[1]);
    } else {
        change.u = curve::nearest(curve::smooth(whole, level, curve::SmoothedEnds::kFree),
                                  asked.ends,
                                  pulled.near[0],
                                  pulled.near[1]);
    }
    auto moved = curve::drag_point(whole, change);
    if (!moved) return impossible(moved.error());
    return std::move(moved).value();
}

// A piece of a curve with corners as a curve of its own, pulled in its own terms.
struct PulledPiece {
    std::size_t piece = 0;
    EditRequest edit;
    RequestedCurve curve;
};

double distance_to(const curve::Points& control,
                   curve::Ends ends,
                   double u,
                   const Pulled& pulled) {
    const std::vector<double> point = curve::point_at(control, ends, u);
    return std::hypot(point[0] - pulled.near[0], point[1] - pulled.near[1]);
}

// The piece that is nearest, and where.
curve::PieceParameter nearest_piece(const curve::CorneredCurve& curve,
                                    const Pulled& pulled) {
    curve::PieceParameter best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const curve::Points& control = curve.pieces[i];
        const double u =
            curve::nearest(control, curve.piece_ends(), pulled.near[0], pulled.near[1]);
        const double distance = distance_to(control, curve.piece_ends(), u, pulled);
        if (distance < least) best = {i, u};
        least = std::min(least, distance);
    }
    return best;
}

// An index counts the control points of all pieces, one piece after the other.
std::optional<PulledPiece> piece_of_index(const EditRequest& edit,
                                          const curve::CorneredCurve& curve) {
    double index = *edit.pulled.index;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const int level = level_of_piece(curve, i);
        const int controls =
            edit.level ? curve::RealLevel(std::min<double>(*edit.level, level)).ceil()
                       : level;
        const auto count =
            static_cast<double>(curve::control_count(controls, curve.piece_ends()));
        if (index >= 0 && index < count) {
            PulledPiece pulled{i, edit, {}};
            pulled.edit.pulled.index = index;
            return pulled;
        }
        index -= count;
    }
    return {};
}

Outcome<PulledPiece> pulled_piece(const EditRequest& edit, const CorneredRequest& asked) {
    PulledPiece pulled{0, edit, {}};
    if (edit.pulled.index) {
        auto found = piece_of_index(edit, asked.curve);
        if (!found)
            return impossible("out_of_range",
                              "control.index '" + number_text(*edit.pulled.index) +
                                  "' is beyond the control points of all pieces",
                              "control.index");
        pulled = *std::move(found);
    } else {
        curve::PieceParameter at;
        if (edit.pulled.u)
            at = curve::piece_at(asked.curve, *edit.pulled.u);
        else
            at = nearest_piece(edit.drag == curve::Drag::kSmooth && edit.level
                                   ? curve::smooth(asked.curve, *edit.level)
                                   : asked.curve,
                               edit.pulled);
        pulled.piece = at.piece;
        pulled.edit.pulled.u = at.u;
        pulled.edit.pulled.near.clear();
    }
    pulled.curve.control = asked.curve.pieces[pulled.piece];
    pulled.curve.ends = asked.curve.piece_ends();
    pulled.curve.level = level_of_piece(asked.curve, pulled.piece);
    if (edit.level) pulled.edit.level = std::min<double>(*edit.level, pulled.curve.level);
    return pulled;
}

// u of the whole between which pieces differ: that of the edited one, and of its neighbours
// where a shared end took them along.
std::array<double, 2> affected_of(const curve::CorneredCurve& before,
                                  const curve::CorneredCurve& after,
                                  std::size_t edited,
                                  double level) {
    const std::size_t count = before.pieces.size();
    const auto of_piece = [&](std::size_t i) -> std::optional<std::array<double, 2>> {
        const int knots =
            std::min(curve::RealLevel(level).ceil(), level_of_piece(before, i));
        const curve::Interval part = curve::affected_by_edit(
            before.pieces[i], after.pieces[i], before.piece_ends(), knots);
        if (part.from == part.to) return {};
        const curve::PieceRange range = curve::range_of(before, i);
        const double size = range.to - range.from;
        return std::array<double, 2>{range.from + part.from * size,
                                     range.from + part.to * size};
    };
    std::array<double, 2> affected = of_piece(edited).value_or(std::array<double, 2>{});
    if (count == 1) return affected;
    const bool around = before.ends == curve::Ends::kClosed;
    if (around || edited > 0)
        if (const auto part = of_piece((edited + count - 1) % count))
            affected[0] = (*part)[0];
    if (around || edited + 1 < count)
        if (const auto part = of_piece((edited + 1) % count)) affected[1] = (*part)[1];
    for (double& u : affected)
        if (u > 1) u -= 1;
    return affected;
}

void add_edit(JsonObject& reply,
              double level,
              std::array<double, 2> affected,
              const std::vector<double>& moved) {
    reply.number("edit_level", level)
        .json("affected", numbers_text(affected))
        .json("moved", numbers_text(moved));
}

Reply edit_pieces(const EditRequest& edit, CurveSource source) {
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    RequestedCurve first;
    first.control = asked->curve.pieces.front();
    if (auto problem = refuse_pulled(edit.pulled, first)) return *std::move(problem);
    if (edit.level)
        if (auto problem = refuse_level("level", *edit.level, asked->level))
            return *std::move(problem);
    auto pulled = pulled_piece(edit, *asked);
    if (!pulled) return pulled.problem();
    if (!edit.level) {
        auto level = level_of_portion(pulled->edit, pulled->curve);
        if (!level) return level.problem();
        pulled->edit.level = *level;
    }
    const double level = *pulled->edit.level;
    auto changed = edited(pulled->edit, pulled->curve, level);
    if (!changed) return changed.problem();
    const curve::CorneredCurve before = asked->curve;
    curve::replace_piece(asked->curve,
                         pulled->piece,
                         std::move(changed->control),
                         static_cast<int>(level));

    std::string text;
    JsonObject reply(text);
    add_cornered(reply, asked->curve, *asked);
    add_edit(reply,
             level,
             affected_of(before, asked->curve, pulled->piece, level),
             changed->moved);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace

Reply post_curve_edit(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto edit = read_edit(*inputs);
    if (!edit) return edit.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if (has_corners(*source)) return edit_pieces(*edit, *std::move(source));
    auto asked = to_curve(*std::move(source));
    if (!asked) return asked.problem();
    if (auto problem = refuse_pulled(edit->pulled, *asked)) return *std::move(problem);
    if (!edit->level) {
        auto level = level_of_portion(*edit, *asked);
        if (!level) return level.problem();
        edit->level = *level;
    }
    if (auto problem = refuse_level("level", *edit->level, asked->level))
        return *std::move(problem);
    auto changed = edited(*edit, *asked, *edit->level);
    if (!changed) return changed.problem();

    std::string text;
    JsonObject reply(text);
    add_curve(reply, changed->control, asked->level, *asked);
    add_edit(reply,
             *edit->level,
             {changed->affected.from, changed->affected.to},
             changed->moved);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
