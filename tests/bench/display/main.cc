// haarmony-bench-display: what it costs to draw a frame, for each of its pixels, beside
// copying a ready picture of that size: in turns, in one process, by the processor time of
// the thread. Frames are drawn one after the other, so that each finds the caches as another
// one left them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/video/display.h"
#include "engine/video/incremental_display.h"
#include "engine/video/panorama.h"
#include "engine/video/shutter.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace {

using namespace haarmony::video;

struct Options {
    int width = 768;
    int height = 432;
    int frames = 8;
    int rounds = 31;
};

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

// Noise everywhere, as of a camera, so that no square is flat; a part of it moves.
testing::RawClip noise(const Options& options) {
    std::mt19937 random(1);
    testing::RawClip clip;
    clip.format = {options.width, options.height, {25, 1}};
    for (int t = 0; t < options.frames; ++t) {
        Picture frame = t == 0 ? Picture(options.width, options.height) : clip.frames[0];
        for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
            if (t > 0 &&
                i % std::size_t(options.width) > std::size_t(options.width / 2)) {
                continue;
            }
            const auto bits = std::uint32_t(random());
            frame.pixels[i] = {std::uint8_t(bits),
                               std::uint8_t(bits >> 8),
                               std::uint8_t(bits >> 16),
                               255};
        }
        clip.frames.push_back(std::move(frame));
    }
    return clip;
}

// One of several ways of making pictures, by turns: `work(i)` makes the i-th.
struct Contender {
    std::string name;
    double pixels = 0;  // of one picture
    std::function<void(std::size_t)> work;
    std::vector<double> seconds = {};  // for one picture
};

// The first is what the others are compared with.
void measure(std::vector<Contender> contenders, int rounds) {
    // Long enough for the clock; the first round only warms.
    for (int round = 0; round <= rounds; ++round) {
        for (Contender& contender : contenders) {
            const auto times = std::size_t(std::max(8.0, 4e6 / contender.pixels));
            const double begin = thread_seconds();
            for (std::size_t i = 0; i < times; ++i) contender.work(i);
            const double seconds = (thread_seconds() - begin) / double(times);
            if (round > 0) contender.seconds.push_back(seconds);
        }
    }
    for (const Contender& contender : contenders) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < contender.seconds.size(); ++i) {
            ratios.push_back(contender.seconds[i] / contenders[0].seconds[i]);
        }
        const double ratio = median(ratios);
        for (double& value : ratios) value = std::abs(value - ratio);
        const double seconds = median(contender.seconds);
        std::printf("| display/%s/%.0f | %.1f | %.2f | %.2f | %.2f |\n",
                    contender.name.c_str(),
                    contender.pixels,
                    seconds * 1e6,
                    contender.pixels / seconds * 1e-9,
                    ratio,
                    median(ratios));
    }
}

std::vector<Frame> frames_of_level(const TimeTree& clip, int time_level) {
    std::vector<Frame> frames;
    for (std::int64_t i = 0; i < clip.shape().nodes_at(time_level); ++i) {
        frames.push_back(*clip.frame({time_level, i}, clip.shape().space_levels()));
    }
    return frames;
}

void measure_levels(const TimeTree& clip, int rounds) {
    const ClipShape& shape = clip.shape();
    const std::vector<Frame> leaves = frames_of_level(clip, shape.time_levels());
    const std::vector<Frame> root = frames_of_level(clip, 0);
    for (int half = 0; half <= 3; ++half) {
        const int level = shape.space_levels() - half;
        const PixelBox box{0, 0, shape.width_at(level), shape.height_at(level)};
        const double pixels = double(box.width) * box.height;
        std::vector<Picture> ready;
        for (const Frame& frame : leaves) {
            ready.push_back(draw(frame, level, Edge::kNormalize));
        }
        Picture out(box.width, box.height);
        const auto drawn = [&](const std::vector<Frame>& frames) {
            return [&](std::size_t i) {
                draw(frames[i % frames.size()],
                     level,
                     Edge::kNormalize,
                     box,
                     out.pixels.data(),
                     box.width);
            };
        };
        const std::string part = "1/" + std::to_string(1 << half);
        measure({{"copy-" + part,
                  pixels,
                  [&](std::size_t i) {
                      std::memcpy(out.pixels.data(),
                                  ready[i % ready.size()].pixels.data(),
                                  out.pixels.size() * sizeof(Rgba));
                  }},
                 {"leaf-" + part, pixels, drawn(leaves)}},
                rounds);
        // The same frame again and again, as the root of the time tree is only one.
        const std::vector<Frame> one = {leaves[1]};
        measure({{"one-leaf-" + part, pixels, drawn(one)},
                 {"root-" + part, pixels, drawn(root)}},
                rounds);
    }
}

void measure_others(const TimeTree& clip, int rounds) {
    const ClipShape& shape = clip.shape();
    const int finest = shape.space_levels();
    const std::vector<Frame> leaves = frames_of_level(clip, shape.time_levels());
    const PixelBox box{0, 0, shape.width(), shape.height()};
    const double pixels = double(box.width) * box.height;
    Picture out(box.width, box.height);
    Picture kept(box.width, box.height);
    draw(leaves.back(), finest, Edge::kNormalize, box, kept.pixels.data(), box.width);
    const std::int32_t root_side = (std::int32_t{1} << finest) * 3 / 4;
    const PixelBox zoomed{
        0, 0, zoomed_width(shape, root_side), zoomed_height(shape, root_side)};
    const PanoramaView view{10, 0, 90, 640, 360};
    measure({{"leaf",
              pixels,
              [&](std::size_t i) {
                  draw(leaves[i % leaves.size()],
                       finest,
                       Edge::kNormalize,
                       box,
                       out.pixels.data(),
                       box.width);
              }},
             {"changes",
              pixels,
              [&](std::size_t i) {
                  draw_changes(leaves[(i + leaves.size() - 1) % leaves.size()],
                               leaves[i % leaves.size()],
                               finest,
                               Edge::kNormalize,
                               box,
                               kept.pixels.data(),
                               box.width);
              }},
             {"shutter-all-but-one",
              pixels,
              [&](std::size_t) {
                  (void)draw_shutter(
                      clip, {1, shape.frames()}, finest, Edge::kNormalize, box);
              }},
             {"zoom-3/4",
              double(zoomed.width) * zoomed.height,
              [&](std::size_t i) {
                  (void)zoom(
                      leaves[i % leaves.size()], root_side, Edge::kNormalize, zoomed);
              }},
             {"panorama",
              640.0 * 360,
              [&](std::size_t) {
                  (void)draw_panorama(clip, {shape.time_levels(), 0}, view);
              }}},
            rounds);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures how fast frames are drawn.");
    app.add_option("--width", options.width, "of the clip")->check(CLI::Range(8, 4096));
    app.add_option("--height", options.height, "of the clip")->check(CLI::Range(8, 4096));
    app.add_option("--frames", options.frames, "of the clip")->check(CLI::Range(2, 64));
    app.add_option("--rounds", options.rounds, "rounds that are counted")
        ->check(CLI::Range(1, 10000));
    CLI11_PARSE(app, argc, argv);
    const std::unique_ptr<MemoryClip> clip = testing::linked_clip(noise(options));
    std::puts("| name | us | GPix/s | x the first above | deviation |");
    std::puts("|---|---|---|---|---|");
    measure_levels(*clip, options.rounds);
    measure_others(*clip, options.rounds);
    return 0;
}
