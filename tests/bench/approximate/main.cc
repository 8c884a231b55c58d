// haarmony-bench-approximate: what it costs to approximate strokes, measured error included,
// beside evaluating them at 16 points a segment: in turns, in one process, by the processor
// time of the thread. Ends with 1 if an approximation breaks its promise.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/curve/approximate.h"
#include "engine/curve/bspline.h"
#include "engine/curve/plane_cubic.h"
#include "tests/bench/approximate/strokes.h"
#include "tests/eval/cpu_clock.h"
#include "tests/eval/quantile.h"

namespace {

using namespace haarmony::curve;
using haarmony::eval::cpu_ms_of;
using haarmony::eval::median_deviation;
using haarmony::eval::quantile;

constexpr int kPointsPerSegment = 16;

// The baseline. The sum keeps the compiler from leaving it out.
double evaluate(const std::vector<Points>& strokes) {
    double sum = 0;
    for (const Points& control : strokes) {
        const Points bezier = bezier_points(control, Ends::kOpen);
        for (std::size_t row = 0; row + 3 < bezier.size(); row += 3) {
            const PlanePolynomial segment(cubic_at(bezier, row));
            for (int k = 0; k < kPointsPerSegment; ++k) {
                const PlaneVector p = segment.value(double(k) / kPointsPerSegment);
                sum += p.x + p.y;
            }
        }
    }
    return sum;
}

struct Totals {
    std::size_t segments = 0;
    int broken = 0;      // promises
    double closest = 0;  // largest max_error / tolerance
};

Totals approximate_all(const std::vector<Points>& strokes,
                       double tolerance,
                       Joining mode) {
    Totals totals;
    for (const Points& control : strokes) {
        const auto a = approximate(control, Ends::kOpen, tolerance, mode, {});
        if (!a || !(a->max_error <= a->bound && a->bound <= tolerance)) {
            ++totals.broken;
            continue;
        }
        totals.segments += a->count();
        totals.closest = std::max(totals.closest, a->max_error / tolerance);
    }
    return totals;
}

}  // namespace

int main(int argc, char** argv) {
    int rounds = 7;
    std::string file;
    CLI::App app("Measures how fast strokes are approximated, and by how many segments.");
    app.add_option("--rounds", rounds, "rounds that count")->check(CLI::PositiveNumber);
    app.add_option("--strokes", file, "JSON with strokes; else they are drawn by code");
    CLI11_PARSE(app, argc, argv);

    const std::vector<Points> strokes = file.empty()
                                            ? haarmony::bench::drawn_strokes()
                                            : haarmony::bench::read_strokes(file);
    std::size_t points = 0;
    for (const Points& control : strokes) points += control.size();
    struct Mode {
        const char* name;
        Joining joining;
    };
    int broken = 0;
    double checksum = 0;
    std::printf("%zu strokes, %zu control points\n\n", strokes.size(), points);
    std::puts(
        "| name | segments | max_error / tolerance, largest | us a control point | "
        "x evaluating | deviation |");
    std::puts("|---|---|---|---|---|---|");
    for (const Mode mode :
         {Mode{"dyadic", Joining::kDyadic}, {"c0", Joining::kC0}, {"g1", Joining::kG1}}) {
        for (const double tolerance : {0.5, 1.0, 2.0, 5.0}) {
            Totals totals;
            std::vector<double> own;
            std::vector<double> ratios;
            // The first round only warms.
            for (int round = 0; round <= rounds; ++round) {
                const double base = cpu_ms_of([&] { checksum += evaluate(strokes); });
                const double time = cpu_ms_of(
                    [&] { totals = approximate_all(strokes, tolerance, mode.joining); });
                if (round == 0) continue;
                own.push_back(time);
                ratios.push_back(time / base);
            }
            std::printf("| approximate/%s-%g/%zu | %zu | %.4f | %.2f | %.1f | %.1f |\n",
                        mode.name,
                        tolerance,
                        points,
                        totals.segments,
                        totals.closest,
                        quantile(own, 0.5) / double(points) * 1e3,
                        quantile(ratios, 0.5),
                        median_deviation(ratios));
            broken += totals.broken;
        }
    }
    std::printf("\n%d promises broken (checksum %.6g)\n", broken, checksum);
    return broken > 0 ? 1 : 0;
}
