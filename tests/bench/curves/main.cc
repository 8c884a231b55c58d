// haarmony-bench-curves: what it costs to take a curve apart and to put it together again,
// for each of its control points, beside copying the points: in turns, in one process, by the
// processor time of the thread.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "engine/curve/multires_curve.h"
#include "tests/eval/cpu_clock.h"
#include "tests/eval/quantile.h"

namespace {

using namespace haarmony::curve;
using namespace haarmony::eval;

struct Options {
    std::vector<int> levels = {8, 10, 12, 14, 18, 20};
    int dimension = 2;
    int rounds = 31;
    bool closed = false;
};

// One of several ways of passing over the same points, by turns.
struct Contender {
    const char* name;
    std::function<double()> work;  // returns a number that depends on all of the result
    std::vector<double> times_ms = {};
};

Points random_curve(std::size_t count, int dimension) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> step(-10, 10);
    Points points(count, dimension);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t d = 0; d < std::size_t(dimension); ++d)
            points[i][d] = (i == 0 ? 500 : points[i - 1][d]) + step(random);
    return points;
}

void measure(int level, const Options& options) {
    const Ends ends = options.closed ? Ends::kClosed : Ends::kOpen;
    const Points control = random_curve(control_count(level, ends), options.dimension);
    const MultiresCurve curve = decompose(control, ends);
    Contender contenders[] = {
        {"copy", [&] { return Points(control).numbers().back(); }},
        {"decompose", [&] { return decompose(control, ends).coarse.numbers().back(); }},
        {"reconstruct", [&] { return reconstruct(curve).numbers().back(); }},
    };
    // Long enough for the clock, and as often for each.
    const std::size_t times = std::max<std::size_t>(1, 100'000 / control.size());
    double sink = 0;
    // The first round only warms.
    for (int round = 0; round <= options.rounds; ++round) {
        for (Contender& contender : contenders) {
            const double time_ms = cpu_ms_of([&] {
                for (std::size_t i = 0; i < times; ++i) sink += contender.work();
            });
            if (round > 0) contender.times_ms.push_back(time_ms / double(times));
        }
    }
    if (!std::isfinite(sink)) std::puts("a result is not finite");
    for (const Contender& contender : contenders) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < contender.times_ms.size(); ++i)
            ratios.push_back(contender.times_ms[i] / contenders[0].times_ms[i]);
        std::printf("| curve/%s-%dd%s/%zu | %.1f | %.1f | %.1f |\n",
                    contender.name,
                    options.dimension,
                    options.closed ? "-closed" : "",
                    control.size(),
                    quantile(contender.times_ms, 0.5) / double(control.size()) * 1e6,
                    quantile(ratios, 0.5),
                    median_deviation(ratios));
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures how fast curves are decomposed and reconstructed.");
    app.add_option("--level", options.levels, "levels of the curves")
        ->delimiter(',')
        ->check(CLI::Range(1, kMostLevel));
    app.add_option("--dimension", options.dimension, "numbers of a point")
        ->check(CLI::Range(1, kMostDimensions));
    app.add_option("--rounds", options.rounds, "rounds that are counted")
        ->check(CLI::Range(1, 10000));
    app.add_flag("--closed", options.closed, "closed curves");
    CLI11_PARSE(app, argc, argv);
    std::puts("| name | ns a control point | x copy | deviation |");
    std::puts("|---|---|---|---|");
    for (const int level : options.levels) measure(level, options);
    return 0;
}
