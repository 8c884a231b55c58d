// haarmony-bench-video: what building a clip costs, in turns with plain ways to do the same,
// in one process, by the processor time of the thread.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/video/clip_shape.h"
#include "tests/bench/video/means.h"

int main(int argc, char** argv) {
    namespace bench = haarmony::video::bench;
    CLI::App app("Measures multiresolution video.");
    app.require_subcommand(1);

    bench::MeansOptions means;
    CLI::App* const means_command = app.add_subcommand("means", "frames and exact means");
    means_command->add_option("--width", means.width, "pixels")
        ->check(CLI::Range(1, haarmony::video::kMaxSide));
    means_command->add_option("--height", means.height, "pixels")
        ->check(CLI::Range(1, haarmony::video::kMaxSide));
    means_command->add_option("--rounds", means.rounds, "rounds that are counted")
        ->check(CLI::Range(1, 10000));

    CLI11_PARSE(app, argc, argv);
    if (means_command->parsed() && !bench::measure_means(means)) {
        std::fputs("the means differ\n", stderr);
        return 1;
    }
    return 0;
}
