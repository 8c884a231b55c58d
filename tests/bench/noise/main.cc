// haarmony-bench-noise: searches among pictures without any likeness, the worst case of the
// index, beside the plain lists of Figure 4.2: in turns, by the processor time of the thread,
// every answer compared with a search through all signatures.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/image/index.h"
#include "server/app/thread_executor.h"
#include "tests/bench/http/synthetic_rows.h"
#include "tests/eval/exhaustive_matches.h"
#include "tests/eval/packed_signature.h"
#include "tests/eval/paired_times.h"
#include "tests/eval/plain_search.h"
#include "tests/eval/speed.h"

namespace {

using namespace haarmony;

constexpr unsigned kSeed = 11;
constexpr int kMatches = eval::kSpeedMatches;

struct Options {
    std::int64_t images = 1'000'000;
    std::size_t queries = 15;
    int threads = 2;
};

std::vector<eval::PackedSignature> make_signatures(const Options& options,
                                                   Executor& executor) {
    std::vector<eval::PackedSignature> signatures(std::size_t(options.images));
    executor.parallel_for(signatures.size(), [&](std::size_t i) {
        signatures[i] =
            eval::pack(bench::synthetic_signature(kSeed, std::int64_t(i) + 1));
    });
    return signatures;
}

std::unique_ptr<image::Index> make_index(
    std::span<const eval::PackedSignature> signatures) {
    constexpr std::size_t kApplied = 16384;
    auto index = std::make_unique<image::Index>(
        image::IndexOptions{eval::kPackedCoefficients, 1024});
    std::vector<image::Record> records;
    for (std::size_t i = 0; i < signatures.size(); ++i) {
        records.push_back({ImageId{std::int64_t(i) + 1}, eval::unpack(signatures[i])});
        if (records.size() < kApplied && i + 1 < signatures.size()) continue;
        index->apply(records, {});
        while (index->merge_once()) {
        }
        records.clear();
    }
    return index;
}

// Returns how many answers were wrong.
std::int64_t measure(const eval::SpeedCase& c,
                     std::span<const eval::PackedSignature> signatures,
                     const image::IndexSnapshot& snapshot,
                     const Options& options,
                     Executor& executor) {
    const image::Profile profile = *image::built_in_profile(c.profile);
    std::vector<image::Query> queries;
    std::vector<eval::PlainQuery> plain_queries;
    for (std::size_t i = 0; i < options.queries; ++i) {
        // Of none of the pictures that are in.
        queries.push_back(image::make_query(
            bench::synthetic_signature(kSeed, options.images + 1 + std::int64_t(i)),
            profile,
            c.m));
        plain_queries.push_back(eval::plain_query(queries.back()));
    }
    eval::PlainSearch plain(signatures, c.m);
    std::vector<image::SearchResult> answers(queries.size());
    const eval::PairedTimes times = eval::measure_in_turn(
        queries.size(),
        1,
        [&](std::size_t i) {
            // Volatile: what is not used need not be computed.
            [[maybe_unused]] const volatile float best =
                plain.search(plain_queries[i], kMatches).front().score;
        },
        [&](std::size_t i) { answers[i] = snapshot.search(queries[i], {kMatches}); });
    const auto expected =
        eval::exhaustive_matches(signatures, queries, kMatches, executor);
    std::int64_t compared = 0;
    for (const image::SearchResult& answer : answers) compared += answer.effort.compared;
    std::printf("| search/noise-%s-m%d/%lld | %.1f | %.1f | %.2f | %.2f | %lld |\n",
                std::string(c.profile).c_str(),
                c.m,
                static_cast<long long>(options.images),
                times.first.median_ms,
                times.second.median_ms,
                times.ratio.median,
                times.ratio.deviation,
                static_cast<long long>(compared / std::int64_t(queries.size())));
    return eval::count_mismatches(answers, expected, options.images);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Measures searches among pictures without any likeness.");
    app.add_option("--images", options.images, "pictures")
        ->check(CLI::Range(std::int64_t{256}, std::int64_t{100'000'000}))
        ->capture_default_str();
    app.add_option("--queries", options.queries, "queries of each m")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1000}))
        ->capture_default_str();
    app.add_option("--threads", options.threads, "for making and checking alone")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    server::ThreadExecutor executor(options.threads - 1);
    const auto signatures = make_signatures(options, executor);
    const std::unique_ptr<image::Index> index = make_index(signatures);
    const auto snapshot = index->snapshot();
    std::puts("| name | plain, ms | index, ms | ratio | deviation | pictures compared |");
    std::puts("|---|---|---|---|---|---|");
    std::int64_t wrong = 0;
    for (const eval::SpeedCase& c : eval::kSpeedCases)
        wrong += measure(c, signatures, *snapshot, options, executor);
    if (wrong == 0) return 0;
    std::fprintf(stderr,
                 "haarmony-bench-noise: %lld answers were wrong\n",
                 static_cast<long long>(wrong));
    return 1;
}
