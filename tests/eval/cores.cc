#include "tests/eval/cores.h"

#include <atomic>
#include <cassert>
#include <chrono>
#include <functional>

#include "server/app/thread_executor.h"
#include "tests/eval/paired_times.h"

namespace haarmony::eval {
namespace {

// Each thread answers all queries so many times.
constexpr std::size_t kRounds = 4;

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count();
}

}  // namespace

std::vector<CoresRow> measure_cores(const image::IndexSnapshot& snapshot,
                                    std::span<const image::Query> queries,
                                    int limit,
                                    int threads) {
    assert(!queries.empty() && threads >= 1);
    std::vector<std::vector<image::Match>> expected;
    for (const image::Query& query : queries)
        expected.push_back(snapshot.search(query, {limit}).matches);

    std::vector<CoresRow> rows;
    for (int count = 1; count <= threads; ++count) {
        server::ThreadExecutor workers(count - 1);
        std::atomic<std::int64_t> mismatches = 0;
        const auto ask = [&](std::size_t i, Executor* executor) {
            const std::size_t q = i % queries.size();
            const auto found = snapshot.search(queries[q], {limit, nullptr, executor});
            if (found.matches != expected[q]) ++mismatches;
        };
        const std::size_t each = kRounds * queries.size();
        const double seconds = seconds_of([&] {
            workers.parallel_for(std::size_t(count), [&](std::size_t) {
                for (std::size_t i = 0; i < each; ++i) ask(i, nullptr);
            });
        });
        std::vector<double> alone_ms;
        for (std::size_t i = 0; i < queries.size(); ++i)
            alone_ms.push_back(1e3 * seconds_of([&] { ask(i, &workers); }));
        rows.push_back({snapshot.stats().images,
                        count,
                        double(each) * count / seconds,
                        summarize_times(alone_ms).median_ms,
                        mismatches});
    }
    return rows;
}

}  // namespace haarmony::eval
