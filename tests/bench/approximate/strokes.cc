#include "tests/bench/approximate/strokes.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "engine/curve/level.h"

namespace haarmony::bench {
namespace {

using curve::Ends;
using curve::Points;

constexpr double kTurn = 2 * std::numbers::pi;

struct Place {
    double x, y;
};
Place on_spiral(double u) {
    const double radius = 40 + 380 * u;
    return {500 + radius * std::cos(4 * kTurn * u),
            500 + radius * std::sin(4 * kTurn * u)};
}
Place on_handwriting(double u) {
    const double loops = 18 * kTurn * u;
    return {50 + 900 * u + 30 * std::sin(loops),
            500 + 90 * std::cos(loops) * (1 + 0.4 * std::sin(5 * kTurn * u))};
}
// Waves whose height falls with their length, as those of a coast do.
Place on_coast(double u, const std::vector<double>& phases) {
    double radius = 300;
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const double wave = double(k + 2);
        radius += 120 / wave * std::sin(wave * kTurn * u + phases[k]);
    }
    return {500 + radius * std::cos(kTurn * u), 500 + radius * std::sin(kTurn * u)};
}

[[noreturn]] void give_up(const std::string& message) {
    std::fprintf(stderr, "haarmony-bench-approximate: %s\n", message.c_str());
    std::exit(3);
}

}  // namespace

std::vector<Points> drawn_strokes() {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> phase(0, kTurn);
    std::vector<double> phases(60);
    for (double& p : phases) p = phase(random);
    std::vector<Points> strokes;
    for (const int level : {8, 10, 12}) {
        for (const double sigma : {0.3, 1.0}) {
            for (int kind = 0; kind < 3; ++kind) {
                std::normal_distribution<double> noise(0, sigma);
                Points control(curve::control_count(level, Ends::kOpen), 2);
                for (std::size_t i = 0; i < control.size(); ++i) {
                    const double u = double(i) / double(control.size() - 1);
                    const Place p = kind == 0   ? on_spiral(u)
                                    : kind == 1 ? on_handwriting(u)
                                                : on_coast(u, phases);
                    control[i][0] = p.x + noise(random);
                    control[i][1] = p.y + noise(random);
                }
                strokes.push_back(std::move(control));
            }
        }
    }
    return strokes;
}

std::vector<Points> read_strokes(const std::string& path) {
    std::ifstream stream(path);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    if (json.is_discarded() || !json.contains("strokes")) {
        give_up(path + ": not a JSON object with \"strokes\"");
    }
    std::vector<Points> strokes;
    for (const auto& stroke : json["strokes"]) {
        const auto rows = stroke.value("control", std::vector<std::vector<double>>{});
        if (!curve::level_of(rows.size(), Ends::kOpen)) {
            give_up(path + ": " + std::to_string(rows.size()) +
                    " control points are of no level");
        }
        Points control(rows.size(), 2);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i].size() != 2) give_up(path + ": a control point is not [x, y]");
            control[i][0] = rows[i][0];
            control[i][1] = rows[i][1];
        }
        strokes.push_back(std::move(control));
    }
    if (strokes.empty()) give_up(path + ": no strokes");
    return strokes;
}

}  // namespace haarmony::bench
