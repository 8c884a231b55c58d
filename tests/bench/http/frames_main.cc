// haarmony-bench-frames: what a viewer of a video waits for: squares somewhere in its frames,
// over one connection that is kept open.
//
//   touched   the first square of each frame, in random order: its layers are decoded for it,
//             unless the daemon has shown the frame before
//   drawn     squares that nobody asked for before, of frames that were touched
//   kept      each of these asked for again, in turns with the first time
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "tests/bench/http/load.h"
#include "tests/bench/http/quantiles.h"
#include "tests/support/http_client.h"

namespace haarmony::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

struct Options {
    std::uint16_t port = 8080;
    std::int64_t video = 1;
    int side = 256;
    std::string format = "png";
    int requests = 300;
    int rounds = 3;
};

// Milliseconds: of the viewer, and of the daemon where it made the picture.
struct Shown {
    double total = 0;
    double decode = 0;
    double draw = 0;
    double encode = 0;
};

class Viewer {
  public:
    explicit Viewer(const Options& options) : options_(options), client_(options.port) {
        const auto reply = client_.get("/videos/" + std::to_string(options.video));
        if (reply.status != 200) throw std::runtime_error(reply.body);
        const auto video = nlohmann::json::parse(reply.body);
        width_ = video.at("width");
        height_ = video.at("height");
        frames_ = video.at("frames");
        if (width_ < options.side || height_ < options.side)
            throw std::runtime_error("the video is smaller than the square");
    }

    [[nodiscard]] int frames() const { return frames_; }
    [[nodiscard]] int any_frame() { return up_to(frames_ - 1); }

    // The address of a square of the frame that was not asked for before.
    std::string square_of(int frame) {
        constexpr int kTries = 1'000;
        for (int i = 0; i < kTries; ++i) {
            const int x = up_to(width_ - options_.side);
            const int y = up_to(height_ - options_.side);
            if (!asked_.emplace(frame, x, y).second) continue;
            // From the middle of the first pixel to the middle of the last: outward, these
            // are whole pixels, however the shares are rounded.
            const auto share = [](double part, int whole) {
                return std::to_string(part / whole);
            };
            return "/video/frame?video=" + std::to_string(options_.video) +
                   "&frame=" + std::to_string(frame) + "&x=" + share(x + 0.5, width_) +
                   "&y=" + share(y + 0.5, height_) +
                   "&w=" + share(options_.side - 1, width_) +
                   "&h=" + share(options_.side - 1, height_) +
                   "&format=" + options_.format;
        }
        throw std::runtime_error("the video has too few squares for so many requests");
    }

    Shown ask(const std::string& address) {
        const Clock::time_point start = Clock::now();
        const test::HttpReply reply = client_.get(address);
        const Milliseconds waited = Clock::now() - start;
        const std::string side = std::to_string(options_.side);
        if (reply.status != 200 || reply.header("x-width") != side ||
            reply.header("x-height") != side)
            throw std::runtime_error(
                address + ": status " + std::to_string(reply.status) + ", " +
                reply.header("x-width") + " x " + reply.header("x-height"));
        Shown shown{waited.count(), 0, 0, 0};
        const std::string timing = reply.header("server-timing");
        if (timing.empty()) return shown;
        shown.decode = number_after(timing, "decode;dur=");
        shown.draw = number_after(timing, "draw;dur=");
        shown.encode = number_after(timing, "encode;dur=");
        return shown;
    }

  private:
    int up_to(int most) { return std::uniform_int_distribution<int>(0, most)(random_); }

    Options options_;
    test::HttpClient client_;
    std::mt19937 random_{1};
    std::set<std::tuple<int, int, int>> asked_;
    int width_ = 0;
    int height_ = 0;
    int frames_ = 0;
};

Quantiles quantiles(const std::vector<Shown>& all, double Shown::*part) {
    std::vector<double> values;
    for (const Shown& shown : all) values.push_back(shown.*part);
    return quantiles_of(std::move(values));
}

void print(const Options& options, const char* what, const std::vector<Shown>& all) {
    const Quantiles total = quantiles(all, &Shown::total);
    std::printf("| video/frame-%s-%s/%d | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n",
                what,
                options.format.c_str(),
                options.side,
                total.p50,
                total.p90,
                total.p99,
                quantiles(all, &Shown::decode).p50,
                quantiles(all, &Shown::draw).p50,
                quantiles(all, &Shown::encode).p50);
}

std::vector<Shown> touch_all(Viewer& viewer) {
    std::vector<int> frames(static_cast<std::size_t>(viewer.frames()));
    std::iota(frames.begin(), frames.end(), 0);
    std::shuffle(frames.begin(), frames.end(), std::mt19937(2));
    std::vector<Shown> touched;
    for (const int frame : frames) touched.push_back(viewer.ask(viewer.square_of(frame)));
    return touched;
}

void run(const Options& options) {
    Viewer viewer(options);
    std::puts(
        "| name | p50, ms | p90, ms | p99, ms | decode, ms | draw, ms | encode, ms |");
    std::puts("|---|---|---|---|---|---|---|");
    print(options, "touched", touch_all(viewer));
    std::vector<double> ratios;
    for (int round = 0; round < options.rounds; ++round) {
        std::vector<Shown> drawn;
        std::vector<Shown> kept;
        for (int i = 0; i < options.requests; ++i) {
            const std::string address = viewer.square_of(viewer.any_frame());
            drawn.push_back(viewer.ask(address));
            kept.push_back(viewer.ask(address));
            ratios.push_back(drawn.back().total / kept.back().total);
        }
        print(options, "drawn", drawn);
        print(options, "kept", kept);
    }
    const double ratio = quantiles_of(ratios).p50;
    for (double& value : ratios) value = std::abs(value - ratio);
    std::printf("drawn / kept: %.1f, deviation %.1f\n", ratio, quantiles_of(ratios).p50);
}

}  // namespace
}  // namespace haarmony::bench

int main(int argc, char** argv) {
    haarmony::bench::Options options;
    CLI::App app("Measures how long a running daemon takes for a picture of a video.");
    app.add_option("--port", options.port, "of the daemon, on this machine")
        ->capture_default_str();
    app.add_option("--video", options.video, "its id")->capture_default_str();
    app.add_option("--side", options.side, "of the square, in pixels")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    app.add_option("--format", options.format)
        ->check(CLI::IsMember({"png", "webp", "jpeg", "rgba"}))
        ->capture_default_str();
    app.add_option("--requests", options.requests, "in each round")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--rounds", options.rounds)
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        haarmony::bench::run(options);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "haarmony-bench-frames: " << error.what() << '\n';
        return 1;
    }
}
