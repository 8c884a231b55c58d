// haarmony-bench-drag: what a reader of the page waits for while a curve is dragged: an edit
// sent and its reply received whole, over one connection that is kept open, beside the same
// edit in this process, in turns.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/curve/direct_edit.h"
#include "engine/curve/multires_curve.h"
#include "tests/bench/http/quantiles.h"
#include "tests/support/http_client.h"

namespace haarmony::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

struct Options {
    std::uint16_t port = 8080;
    int level = 10;
    double edit_level = 3.4;
    int requests = 500;
    int rounds = 5;
};

curve::Points random_curve(int level) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> step(-10, 10);
    curve::Points points(curve::control_count(level, curve::Ends::kOpen), 2);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t d = 0; d < 2; ++d)
            points[i][d] = (i == 0 ? 500 : points[i - 1][d]) + step(random);
    return points;
}

// As a page writes numbers: in as many digits as they need.
std::string number_text(double number) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.17g", number);
    return {text.data(), static_cast<std::size_t>(length)};
}

std::string points_text(const curve::Points& points) {
    std::string text = "[";
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i > 0) text += ',';
        text += '[' + number_text(points[i][0]) + ',' + number_text(points[i][1]) + ']';
    }
    return text + ']';
}

class Dragging {
  public:
    explicit Dragging(const Options& options)
        : options_(options),
          control_(random_curve(options.level)),
          head_("{\"points\":" + points_text(control_) + ",\"level\":" +
                number_text(options.edit_level) + ",\"point\":{\"u\":0.4,\"delta\":["),
          client_(options.port) {}

    double request(double x, double y) {
        const std::string body = head_ + number_text(x) + ',' + number_text(y) + "]}}";
        const Clock::time_point start = Clock::now();
        const test::HttpReply reply = client_.request(
            "POST", "/curve/edit", "Content-Type: application/json\r\n", body);
        const Milliseconds waited = Clock::now() - start;
        if (reply.status != 200)
            throw std::runtime_error("status " + std::to_string(reply.status) + ": " +
                                     reply.body);
        bytes_ = reply.body.size();
        return waited.count();
    }

    double engine(double x, double y) {
        curve::PointEdit edit;
        edit.level = options_.edit_level;
        edit.u = 0.4;
        const std::array delta = {x, y};
        edit.delta = delta;
        const Clock::time_point start = Clock::now();
        const auto edited =
            curve::drag_point(curve::decompose(control_, curve::Ends::kOpen), edit);
        const Milliseconds waited = Clock::now() - start;
        if (!edited) throw std::runtime_error(edited.error().message);
        return waited.count();
    }

    [[nodiscard]] std::size_t points() const { return control_.size(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    Options options_;
    curve::Points control_;
    std::string head_;
    test::HttpClient client_;
    std::size_t bytes_ = 0;
};

void run(const Options& options) {
    Dragging dragging(options);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> move(-20, 20);
    std::puts(
        "| name | p50, ms | p90, ms | p99, ms | engine, ms | x engine | deviation |");
    std::puts("|---|---|---|---|---|---|---|");
    for (int round = 0; round < options.rounds; ++round) {
        std::vector<double> waited;
        std::vector<double> alone;
        std::vector<double> ratios;
        for (int i = 0; i < options.requests; ++i) {
            const double x = move(random);
            const double y = move(random);
            waited.push_back(dragging.request(x, y));
            alone.push_back(dragging.engine(x, y));
            ratios.push_back(waited.back() / alone.back());
        }
        const Quantiles http = quantiles_of(waited);
        const double ratio = quantiles_of(ratios).p50;
        for (double& value : ratios) value = std::abs(value - ratio);
        std::printf("| curve/drag-http/%zu | %.2f | %.2f | %.2f | %.3f | %.1f | %.1f |\n",
                    dragging.points(),
                    http.p50,
                    http.p90,
                    http.p99,
                    quantiles_of(alone).p50,
                    ratio,
                    quantiles_of(ratios).p50);
    }
    std::printf("a reply of %zu bytes\n", dragging.bytes());
}

}  // namespace
}  // namespace haarmony::bench

int main(int argc, char** argv) {
    haarmony::bench::Options options;
    CLI::App app("Measures how long a running daemon takes for an edit of a curve.");
    app.add_option("--port", options.port, "of the daemon, on this machine")
        ->capture_default_str();
    app.add_option("--level", options.level, "of the curve")
        ->check(CLI::Range(1, 12))
        ->capture_default_str();
    app.add_option("--edit-level", options.edit_level, "at which it is dragged")
        ->check(CLI::Range(0.0, 12.0))
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
        std::cerr << "haarmony-bench-drag: " << error.what() << '\n';
        return 1;
    }
}
