// Times of two ways to answer the same questions, measured in turn.
//
// Units   milliseconds of CPU time of the thread; ratios of the first to the second.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace haarmony::eval {

struct TimeSummary {
    double median_ms = 0;
    double p90_ms = 0;
    double largest_ms = 0;
};

// Requires: times not empty.
[[nodiscard]] TimeSummary summarize_times(const std::vector<double>& times_ms);

struct RatioSummary {
    double median = 0;
    double deviation = 0;  // the median distance from the median
    double lower_quartile = 0;
    double upper_quartile = 0;
};

// Requires: ratios not empty.
[[nodiscard]] RatioSummary summarize_ratios(const std::vector<double>& ratios);

struct PairedTimes {
    TimeSummary first;
    TimeSummary second;
    RatioSummary ratio;  // of each question's two times
};

// Calls both for each question, one right after the other and by turns the one or the other
// first, `calls` times in a row, and times each row of calls; each is called once before all
// that. What one leaves in the caches, the other finds.
// Requires: questions, calls >= 1; a call takes any time at all.
[[nodiscard]] PairedTimes measure_in_turn(std::size_t questions,
                                          int calls,
                                          const std::function<void(std::size_t)>& first,
                                          const std::function<void(std::size_t)>& second);

// The same of one alone.
[[nodiscard]] TimeSummary measure_alone(std::size_t questions,
                                        int calls,
                                        const std::function<void(std::size_t)>& answer);

}  // namespace haarmony::eval
