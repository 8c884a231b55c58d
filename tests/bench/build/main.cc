// haarmony-bench-build: what both passes of a build and the accounting cost for each pixel of
// the source, beside copying it, in turns, by the processor time of the thread; what the clip
// takes; and how far its pixels are from the exact ones.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/bench/build/measured_build.h"
#include "tests/engine/video/worst_difference.h"

namespace {

using namespace haarmony::video;
using bench::MeasuredBuild;
using bench::thread_seconds;

struct Options {
    std::string raw;
    int width = 640;
    int height = 480;
    int frames = 32;
    int rounds = 7;
    std::vector<double> deltas = {0, 2, 4, 8, 16};
};

// Noise that a camera would have over a scene that pans by a pixel each frame.
std::vector<std::uint8_t> panning_noise(const Options& options) {
    std::mt19937 random(1);
    std::vector<std::uint8_t> bytes;
    for (int t = 0; t < options.frames; ++t) {
        for (int y = 0; y < options.height; ++y) {
            for (int x = 0; x < options.width; ++x) {
                const int scene = (x + t) / 16 * 37 + y / 16 * 91;
                const auto noise = static_cast<std::uint32_t>(random());
                for (int c = 0; c < 3; ++c) {
                    bytes.push_back(static_cast<std::uint8_t>(scene * (c + 1) % 200 + 20 +
                                                              (noise >> (8 * c)) % 5));
                }
                bytes.push_back(255);
            }
        }
    }
    return bytes;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

struct Row {
    std::string name;
    std::vector<double> seconds = {};
    std::vector<double> ratios = {};
};

void print(const Row& row, double pixels) {
    const double ratio = median(row.ratios);
    std::vector<double> distances;
    for (const double value : row.ratios) distances.push_back(std::abs(value - ratio));
    std::printf("| %s | %.1f | %.1f | %.1f |\n",
                row.name.c_str(),
                median(row.seconds) / pixels * 1e9,
                ratio,
                median(distances));
}

double copy_seconds(const std::vector<std::uint8_t>& from,
                    std::vector<std::uint8_t>& to) {
    const double begin = thread_seconds();
    std::copy(from.begin(), from.end(), to.begin());
    return thread_seconds() - begin;
}

void measure(const Options& options, const std::vector<std::uint8_t>& frames) {
    const FrameFormat format{options.width, options.height, {25, 1}};
    const double pixels = static_cast<double>(frames.size()) / 4;
    const std::string size = std::to_string(options.width) + "x" +
                             std::to_string(options.height) + "x" +
                             std::to_string(options.frames);
    bench::WarmSpool spool;
    std::vector<std::uint8_t> copy(frames.size());
    std::unique_ptr<MemoryClip> exact;
    std::vector<std::string> results;
    std::puts("| name | ns a pixel | x copy | deviation |");
    std::puts("|---|---|---|---|");
    for (const double levels : options.deltas) {
        const auto delta = static_cast<std::uint32_t>(levels * kDifferenceOne);
        char name[32];
        std::snprintf(name, sizeof(name), "-delta%g/", levels);
        Row rows[] = {{"build/pass1" + (name + size)},
                      {"build/pass2" + (name + size)},
                      {"build/accounting" + (name + size)}};
        MeasuredBuild last;
        // The first round only warms.
        for (int round = 0; round <= options.rounds; ++round) {
            const double copied = copy_seconds(frames, copy);
            last = bench::measured_build(format, frames, delta, spool);
            if (round == 0) continue;
            const double seconds[] = {last.pass_1, last.pass_2, last.accounting};
            for (std::size_t i = 0; i < std::size(rows); ++i) {
                rows[i].seconds.push_back(seconds[i]);
                rows[i].ratios.push_back(seconds[i] / copied);
            }
        }
        for (const Row& row : rows) print(row, pixels);
        if (exact == nullptr && delta == 0) exact = std::move(last.clip);
        const MemoryClip& clip = last.clip == nullptr ? *exact : *last.clip;
        testing::WorstDifference worst;
        if (exact != nullptr) worst = testing::worst_difference(*exact, clip);
        const double raw = static_cast<double>(frames.size());
        char line[160];
        std::snprintf(line,
                      sizeof(line),
                      "| %g | %.3f | %.3f | %.3f | %.3f | %.3f |",
                      levels,
                      static_cast<double>(clip.memory_bytes()) / raw,
                      static_cast<double>(last.counts.paper_bytes) / raw,
                      static_cast<double>(spool.used()) / raw,
                      static_cast<double>(worst.leaf) / kDifferenceOne,
                      static_cast<double>(worst.coarse) / kDifferenceOne);
        results.emplace_back(line);
    }
    std::puts(
        "\n| delta | memory / raw | dissertation / raw | spool / raw | worst at leaf "
        "frames | worst elsewhere |");
    std::puts("|---|---|---|---|---|---|");
    for (const std::string& line : results) std::puts(line.c_str());
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Measures how fast clips are built, what they take and how exact they are.");
    app.add_option("--raw", options.raw, "frames of straight RGBA instead of made ones");
    app.add_option("--width", options.width, "of a frame")->check(CLI::Range(1, 65536));
    app.add_option("--height", options.height, "of a frame")->check(CLI::Range(1, 65536));
    app.add_option("--frames", options.frames, "at most")->check(CLI::Range(1, 100000));
    app.add_option("--rounds", options.rounds, "that are counted")
        ->check(CLI::Range(1, 1000));
    app.add_option("--delta", options.deltas, "grey levels; 0 first, to be compared with")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 255.0));
    CLI11_PARSE(app, argc, argv);
    std::vector<std::uint8_t> frames;
    if (options.raw.empty()) {
        frames = panning_noise(options);
    } else {
        std::ifstream file(options.raw, std::ios::binary);
        frames.assign(std::istreambuf_iterator<char>(file), {});
        const std::size_t frame = std::size_t{4} *
                                  static_cast<std::size_t>(options.width) *
                                  static_cast<std::size_t>(options.height);
        options.frames = static_cast<int>(
            std::min(frames.size() / frame, static_cast<std::size_t>(options.frames)));
        frames.resize(frame * static_cast<std::size_t>(options.frames));
        if (frames.empty()) {
            std::fprintf(stderr, "%s has not one frame\n", options.raw.c_str());
            return 1;
        }
    }
    measure(options, frames);
    return 0;
}
