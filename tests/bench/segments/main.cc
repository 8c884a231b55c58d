// haarmony-bench-segments: what it costs to build a segment, and to merge four into one,
// beside making the lists of Figure 4.2 of the same pictures: in turns, in one process, by
// the processor time of the thread.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

#include "engine/image/query.h"
#include "engine/image/segment.h"
#include "tests/bench/http/synthetic_rows.h"
#include "tests/eval/cpu_clock.h"
#include "tests/eval/quantile.h"

namespace {

using namespace haarmony;
using namespace haarmony::image;

constexpr unsigned kSeed = 11;

struct Options {
    int pictures = kMaxSegmentSlots;
    int index_m = 60;
    int rounds = 7;
};

using Pointers = std::vector<const Record*>;

// The baseline: lists of 32-bit numbers, counted and then filled.
std::size_t plain_lists(const Pointers& records, int m) {
    const auto for_each = [&](const auto& visit) {
        for (std::uint32_t place = 0; place < records.size(); ++place) {
            for (int c = 0; c < kChannels; ++c) {
                for (const int index : records[place]->signature.channels[c].largest(m))
                    visit(coefficient_key(c, index), place);
            }
        }
    };
    std::vector<std::uint32_t> sizes(kKeyCount);
    for_each([&](std::uint32_t key, std::uint32_t) { ++sizes[key]; });
    std::vector<std::vector<std::uint32_t>> lists(kKeyCount);
    std::size_t postings = 0;
    for (std::size_t key = 0; key < lists.size(); ++key) {
        lists[key].reserve(sizes[key]);
        postings += sizes[key];
    }
    for_each(
        [&](std::uint32_t key, std::uint32_t place) { lists[key].push_back(place); });
    return postings;
}

void print_row(const char* name,
               const Options& options,
               const std::vector<double>& plain,
               const std::vector<double>& own,
               std::size_t postings) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < own.size(); ++round)
        ratios.push_back(own[round] / plain[round]);
    const double ms = eval::quantile(own, 0.5);
    std::printf("| segments/%s-m%d/%d | %.0f | %.2f | %.1f | %.2f | %.2f |\n",
                name,
                options.index_m,
                options.pictures,
                options.pictures / ms * 1e3,
                ms / options.pictures * 1e3,
                ms / double(postings) * 1e6,
                eval::quantile(ratios, 0.5),
                eval::median_deviation(ratios));
}

void measure(const Options& options) {
    std::vector<Record> records;
    for (int i = 1; i <= options.pictures; ++i)
        records.push_back({ImageId{i}, bench::synthetic_signature(kSeed, i)});
    constexpr std::size_t kParts = 4;
    Pointers all;
    std::array<Pointers, kParts> quarters;
    for (const Record& record : records) {
        quarters[all.size() % kParts].push_back(&record);
        all.push_back(&record);
    }
    std::vector<LiveSegment> parts;
    for (const Pointers& quarter : quarters)
        parts.push_back({Segment::from_records(quarter, options.index_m), nullptr});

    std::size_t postings = 0;
    std::vector<double> plain;
    std::vector<double> build;
    std::vector<double> merge;
    // The first round only warms.
    for (int round = 0; round <= options.rounds; ++round) {
        const double for_plain =
            eval::cpu_ms_of([&] { postings = plain_lists(all, options.index_m); });
        const double for_build =
            eval::cpu_ms_of([&] { (void)Segment::from_records(all, options.index_m); });
        const double for_merge = eval::cpu_ms_of([&] { (void)Segment::merge(parts); });
        if (round == 0) continue;
        plain.push_back(for_plain);
        build.push_back(for_build);
        merge.push_back(for_merge);
    }
    std::puts(
        "| name | pictures/s | us a picture | ns a posting | x plain | deviation |");
    std::puts("|---|---|---|---|---|---|");
    print_row("plain", options, plain, plain, postings);
    print_row("build", options, plain, build, postings);
    print_row("merge", options, plain, merge, postings);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures how fast segments are built and merged.");
    app.add_option("--pictures", options.pictures, "pictures of the segment")
        ->check(CLI::Range(4, kMaxSegmentSlots));
    app.add_option("--index-m", options.index_m, "coefficients of each channel")
        ->check(CLI::Range(1, kMaxCoefficients));
    app.add_option("--rounds", options.rounds, "rounds that are counted")
        ->check(CLI::Range(1, 1000));
    CLI11_PARSE(app, argc, argv);
    measure(options);
    return 0;
}
