// Every case of the golden folder through the REST interface.
#include "tests/e2e/golden_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>

namespace haarmony::e2e {
namespace {

using nlohmann::json;

// Lengths that the golden levels were computed from are exact to this.
constexpr double kPortionTolerance = 1e-4;

// A rational as text, "p" or "p/q", or a number.
double number_of(const json& value) {
    if (value.is_number()) return value;
    const auto text = value.get<std::string>();
    const auto slash = text.find('/');
    return std::stod(text) /
           (slash == std::string::npos ? 1 : std::stod(text.substr(slash + 1)));
}

// A column of a matrix that is given by rows, as points of one number.
json column(const json& rows, std::size_t index) {
    json points = json::array();
    for (const json& row : rows) points.push_back({number_of(row.at(index))});
    return points;
}

json zeros(std::size_t count) { return json(count, json::array({0.0})); }

json unit_vector(std::size_t count, std::size_t index) {
    json points = zeros(count);
    points[index][0] = 1;
    return points;
}

TEST_F(GoldenCurves, FiltersAreTheColumnsOfReplies) {
    const json file = read("filters.json");
    for (const auto& [level, filters] : file.at("levels").items()) {
        const std::size_t fine = filters.at("n_control");
        for (std::size_t k = 0; k < fine; ++k) {
            begin("M^" + level + " column " + std::to_string(k));
            const json drawn = ask("/curve/approximate",
                                   {{"points", unit_vector(fine, k)},
                                    {"tolerance", 1e-300},
                                    {"mode", "dyadic"}});
            const json rows = column(filters.at("M"), k);
            json segments = json::array();
            for (std::size_t row = 0; row + 3 < rows.size(); row += 3)
                segments.push_back(
                    {rows[row], rows[row + 1], rows[row + 2], rows[row + 3]});
            equal(drawn.value("segments", json()), segments, "M");
            end();
        }
        if (level == "0") continue;
        const std::size_t coarse = filters.at("P").at(0).size();
        for (std::size_t k = 0; k < coarse; ++k) {
            begin("P^" + level + " column " + std::to_string(k));
            json apart = ask("/curve/decompose", {{"points", unit_vector(coarse, k)}});
            apart.erase("level");
            apart["details"].push_back(zeros(coarse - 3));
            equal(ask("/curve/reconstruct", apart).value("points", json()),
                  column(filters.at("P"), k),
                  "P");
            end();
        }
        json details = json::array();
        for (std::size_t count = 1; count < coarse - 3; count *= 2)
            details.push_back(zeros(count));
        for (std::size_t k = 0; k < coarse - 3; ++k) {
            begin("Q^" + level + " column " + std::to_string(k));
            json all = details;
            all.push_back(unit_vector(coarse - 3, k));
            equal(ask("/curve/reconstruct", {{"coarse", zeros(4)}, {"details", all}})
                      .value("points", json()),
                  column(filters.at("Q_unit"), k),
                  "Q");
            end();
        }
    }
    print("filters.json");
}

TEST_F(GoldenCurves, AreDecomposedAndPutTogetherAgain) {
    const json file = read("decompositions.json");
    for (const json& curve : file.at("curves")) {
        const int finest = curve.at("level");
        begin(curve.at("name"));
        const json apart = ask("/curve/decompose", {{"points", curve.at("control")}});
        equal(apart.value("coarse", json()), curve.at("C").at("0"), "C^0");
        for (int j = 0; j < finest; ++j) {
            const std::string level = std::to_string(j);
            equal(apart.value("details", json(finest, 0)).at(j),
                  curve.at("D_unit").at(level),
                  "D^" + level);
        }
        for (int j = 0; j <= finest; ++j) {
            json whole = apart;
            whole["level"] = j;
            const std::string level = std::to_string(j);
            equal(ask("/curve/reconstruct", whole).value("points", json()),
                  curve.at("C").at(level),
                  "C^" + level);
        }
        for (const char* frame : {"normalized", "unnormalized"}) {
            json turned = ask("/curve/decompose",
                              {{"points", curve.at("control")}, {"frame", frame}});
            turned["frame"] = frame;
            equal(ask("/curve/reconstruct", turned).value("points", json()),
                  curve.at("control"),
                  frame);
        }
        end();
    }
    print("decompositions.json");
}

// Of golden_public.json, by "op".
class PublicCases : public GoldenCurves {
  protected:
    void smooth(const json& c, const json& control) {
        equal(ask("/curve/smooth", {{"points", control}, {"level", c.at("level")}})
                  .value("points", json()),
              c.at("control"),
              "control");
        equal(ask("/curve/evaluate",
                  {{"points", control}, {"level", c.at("level")}, {"u", c.at("u")}})
                  .value("points", json()),
              c.at("points"),
              "points");
    }

    void edit_point(const json& c, const json& control) {
        const json frame = c.value("mode", "fixed");
        const json edited =
            ask("/curve/edit",
                {{"points", control},
                 {"level", c.at("level")},
                 {"frame", frame},
                 {"control", {{"index", c.at("index")}, {"delta", c.at("delta")}}}});
        equal(points_at(edited.value("points", json()), c.at("u")),
              c.at("points"),
              "points");
        if (c.contains("control"))
            equal(edited.value("points", json()), c.at("control"), "control");
        if (!c.contains("local_D_unit")) return;
        const json local =
            ask("/curve/decompose", {{"points", control}, {"frame", frame}});
        for (const auto& [level, details] : c.at("local_D_unit").items())
            equal(
                local.value("details", json()).at(std::stoul(level)), details, "details");
    }

    void edit_direct(const json& c, const json& control) {
        const auto check = [&](const char* drag, const char* points, const char* moved) {
            const json edited =
                ask("/curve/edit",
                    {{"points", control},
                     {"level", c.at("level")},
                     {"drag", drag},
                     {"point", {{"u", c.at("u0")}, {"delta", c.at("delta")}}}});
            equal(points_at(edited.value("points", json()), c.at("u")),
                  c.at(points),
                  points);
            equal(edited.value("moved", json()), c.at(moved), moved);
        };
        check("smooth", "points", "moved_highres");
        check("full", "points_exact_highres", "moved_highres_exact");
    }

    void portion(const json& c, const json& control) {
        const json edited = ask(
            "/curve/edit",
            {{"points", control},
             {"portion", c.at("h")},
             {"point", {{"u", c.at("u0")}, {"delta", json(control[0].size(), 1.0)}}}});
        const double level = edited.value("edit_level", -1.0);
        const double error = std::abs(level - c.at("level").get<double>());
        worst_level_ = std::max(worst_level_, error);
        holds(error <= kPortionTolerance, "level " + std::to_string(level));
    }

    void transfer(const json& c, const json& sweep, const json& character) {
        const json given = ask("/curve/character",
                               {{"points", sweep},
                                {"character", {{"points", character}}},
                                {"from_level", c.at("level")},
                                {"frame", c.at("mode")}});
        equal(points_at(given.value("points", json()), c.at("u")),
              c.at("points"),
              "points");
    }

    json approximated(const json& control, const char* mode, double tolerance) {
        json found = ask("/curve/approximate",
                         {{"points", control}, {"tolerance", tolerance}, {"mode", mode}});
        const double bound = found.value("bound", -1.0);
        holds(0 <= bound && found.value("max_error", INFINITY) <= bound &&
                  bound <= tolerance,
              std::string("the bound of ") + mode);
        return found;
    }

    void compress(const json& c, const json& control) {
        const double tolerance = c.at("eps");
        const json dyadic = approximated(control, "dyadic", tolerance);
        holds(dyadic.value("count", json()) == c.at("segments"), "the count of dyadic");
        holds(dyadic.value("possible", json()) == c.at("of"), "possible");
        equal(dyadic.value("bound", json()), c.at("max_bound"), "bound");
        equal(dyadic.value("max_error", json()), c.at("true_max_error"), "max_error");
        if (c.contains("bezier"))
            equal(dyadic.value("segments", json()), c.at("bezier"), "segments");
        const json joined = approximated(control, "c0", tolerance);
        holds(joined.value("count", json()) == c.at("c0_guarded_segments"),
              "the count of c0");
        equal(joined.value("max_error", json()),
              c.at("c0_guarded_true_max_error"),
              "max_error of c0");
        // Plain averaging is the same where it keeps the tolerance.
        if (c.contains("bezier_c0") && c.at("segments") == c.at("c0_guarded_segments"))
            equal(joined.value("segments", json()), c.at("bezier_c0"), "segments of c0");
        approximated(control, "g1", tolerance);
    }

    // The bound of the one segment of level 0 is ErrBound of all.
    void errbounds(const json& c, const json& control) {
        const double bound = c.at("ErrBound").at("0").at(0);
        const json found = approximated(
            control, "dyadic", bound > 0 ? bound * (1 + 1e-9) : kGoldenTolerance);
        holds(found.value("count", 0) == 1, "one segment");
        equal(found.value("bound", json()), bound, "bound");
    }

    void surface_decompose(const json& c) {
        surface_ = c.at("control");
        json apart = ask("/surface/decompose", {{"points", surface_}});
        equal(apart.value("coarse", json()), c.at("CC").at("0"), "CC^0");
        for (const auto& [level, details] : c.at("CD_DC_DD").items()) {
            const json& got = apart.at("details").at(std::stoul(level));
            equal(
                {got.at("cd"), got.at("dc"), got.at("dd")}, details, "details " + level);
        }
        for (const auto& [level, grid] : c.at("CC").items()) {
            apart["level"] = {std::stoi(level), std::stoi(level)};
            equal(ask("/surface/reconstruct", apart).value("points", json()),
                  grid,
                  "CC^" + level);
        }
    }

    void surface_edit(const json& c) {
        const json edited =
            ask("/surface/edit",
                {{"points", surface_},
                 {"level", {c.at("level_u"), c.at("level_v")}},
                 {"control", {{"index", c.at("index")}, {"delta", c.at("delta")}}}});
        equal(edited.value("points", json()), c.at("control"), "points");
        holds(edited.value("changed", json()) == c.at("changed"), "changed");
    }

    json surface_;  // of the last surface_decompose
    double worst_level_ = 0;
};

TEST_F(PublicCases, AreAnsweredAsKnown) {
    const std::map<std::string, json> controls = curves();
    int ties = 0;
    int number = 0;
    const json file = read("golden_public.json");
    for (const json& c : file.at("cases")) {
        const std::string op = c.at("op");
        const json control =
            c.contains("curve") ? controls.at(c.at("curve")) : json::array();
        // Whether the whole curve is meant depends there on the last digits of its length.
        if (op == "portion" &&
            std::abs(c.at("h").get<double>() - c.at("total_length").get<double>()) <
                1e-5 * c.at("total_length").get<double>()) {
            ++ties;
            continue;
        }
        begin(std::to_string(number++) + " " + op);
        if (op == "smooth")
            smooth(c, control);
        else if (op == "edit_point" || op == "edit_point_oriented")
            edit_point(c, control);
        else if (op == "edit_direct")
            edit_direct(c, control);
        else if (op == "portion")
            portion(c, control);
        else if (op == "transfer")
            transfer(c, controls.at(c.at("sweep")), controls.at(c.at("character")));
        else if (op == "compress")
            compress(c, control);
        else if (op == "errbounds")
            errbounds(c, control);
        else if (op == "surface_decompose")
            surface_decompose(c);
        else if (op == "surface_edit")
            surface_edit(c);
        else
            complain("the operation is unknown");
        end();
    }
    print("golden_public.json");
    std::cout << "golden golden_public.json: portion levels off by " << worst_level_
              << " at most, " << ties << " ties left out\n";
}

TEST_F(PublicCases, TheCounterexampleKeepsItsTolerance) {
    const json c = read("c0_counterexample.json");
    json control = json::array();
    for (const double number : numbers_of(c.at("control"))) control.push_back({number});
    begin("counterexample");
    const json dyadic = approximated(control, "dyadic", c.at("eps"));
    holds(dyadic.value("count", 0U) == c.at("leaves_j_i").size(), "the count");
    equal(dyadic.value("max_error", json()),
          c.at("true_max_error_discontinuous"),
          "max_error");
    approximated(control, "c0", c.at("eps"));
    approximated(control, "g1", c.at("eps"));
    end();
    print("c0_counterexample.json");
}

TEST_F(PublicCases, NoStrokeViolatesItsTolerance) {
    const json file = read("strokes.json");
    for (const double tolerance : {0.5, 1.0, 2.0, 5.0}) {
        for (const char* mode : {"dyadic", "c0", "g1"}) {
            std::int64_t segments = 0;
            for (const json& stroke : file.at("strokes")) {
                begin(stroke.at("name").get<std::string>() + " " + mode);
                segments += approximated(stroke.at("control"), mode, tolerance)
                                .value("count", std::int64_t{0});
                end();
            }
            std::cout << "golden strokes.json: " << mode << " at " << tolerance << ": "
                      << segments << " segments in all\n";
        }
    }
    print("strokes.json");
}

}  // namespace
}  // namespace haarmony::e2e
