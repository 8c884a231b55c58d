#include "tests/eval/paired_times.h"

#include <algorithm>
#include <cassert>

#include "tests/eval/cpu_clock.h"
#include "tests/eval/quantile.h"

namespace haarmony::eval {
namespace {

// A clock that stands still between two looks must not make a ratio infinite.
constexpr double kTick = 1e-6;

double time_of(std::size_t question,
               int calls,
               const std::function<void(std::size_t)>& answer) {
    const double start = thread_cpu_ms();
    for (int call = 0; call < calls; ++call) answer(question);
    return std::max(thread_cpu_ms() - start, kTick) / calls;
}

}  // namespace

TimeSummary summarize_times(const std::vector<double>& times_ms) {
    return {quantile(times_ms, 0.5), quantile(times_ms, 0.9), quantile(times_ms, 1)};
}

RatioSummary summarize_ratios(const std::vector<double>& ratios) {
    return {quantile(ratios, 0.5),
            median_deviation(ratios),
            quantile(ratios, 0.25),
            quantile(ratios, 0.75)};
}

PairedTimes measure_in_turn(std::size_t questions,
                            int calls,
                            const std::function<void(std::size_t)>& first,
                            const std::function<void(std::size_t)>& second) {
    assert(questions >= 1 && calls >= 1);
    first(0);
    second(0);
    std::vector<double> first_ms(questions);
    std::vector<double> second_ms(questions);
    std::vector<double> ratios(questions);
    for (std::size_t q = 0; q < questions; ++q) {
        if (q % 2 == 0) first_ms[q] = time_of(q, calls, first);
        second_ms[q] = time_of(q, calls, second);
        if (q % 2 == 1) first_ms[q] = time_of(q, calls, first);
        ratios[q] = first_ms[q] / second_ms[q];
    }
    return {
        summarize_times(first_ms), summarize_times(second_ms), summarize_ratios(ratios)};
}

TimeSummary measure_alone(std::size_t questions,
                          int calls,
                          const std::function<void(std::size_t)>& answer) {
    assert(questions >= 1 && calls >= 1);
    answer(0);
    std::vector<double> times_ms(questions);
    for (std::size_t q = 0; q < questions; ++q) times_ms[q] = time_of(q, calls, answer);
    return summarize_times(times_ms);
}

}  // namespace haarmony::eval
