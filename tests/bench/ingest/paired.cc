#include "tests/bench/ingest/paired.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <ctime>
#include <numeric>

namespace haarmony::bench {

double process_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

Quartiles quartiles(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        const double part = place - static_cast<double>(below);
        return values[below] + part * (values[above] - values[below]);
    };
    return {at(0.25), at(0.5), at(0.75)};
}

namespace {

double seconds_of(const Contender& contender, std::size_t picture) {
    const double begin = process_seconds();
    contender.work(picture);
    return process_seconds() - begin;
}

// seconds[round][picture]
using Seconds = std::vector<std::vector<double>>;

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// Of each picture the fastest round: what disturbs a round only ever adds to it.
std::vector<double> fastest(const Seconds& seconds) {
    std::vector<double> result = seconds.front();
    for (const std::vector<double>& round : seconds) {
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = std::min(result[i], round[i]);
        }
    }
    return result;
}

}  // namespace

std::vector<Timing> measure_in_turns(const std::vector<Contender>& contenders,
                                     std::size_t pictures,
                                     int rounds) {
    assert(!contenders.empty() && pictures >= 1 && rounds >= 1);
    std::vector<Seconds> seconds(contenders.size());
    for (int round = -1; round < rounds; ++round) {
        for (Seconds& own : seconds) {
            if (round >= 0) own.emplace_back(pictures);
        }
        for (std::size_t picture = 0; picture < pictures; ++picture) {
            for (std::size_t turn = 0; turn < contenders.size(); ++turn) {
                const std::size_t who = (turn + picture) % contenders.size();
                const double spent = seconds_of(contenders[who], picture);
                if (round >= 0) seconds[who].back()[picture] = spent;
            }
        }
    }

    const std::vector<double> first = fastest(seconds.front());
    std::vector<Timing> timings;
    for (std::size_t who = 0; who < contenders.size(); ++who) {
        const std::vector<double> own = fastest(seconds[who]);
        std::vector<double> ratios;
        for (std::size_t i = 0; i < pictures; ++i) ratios.push_back(own[i] / first[i]);
        std::vector<double> round_ratios;
        for (std::size_t r = 0; r < seconds[who].size(); ++r) {
            round_ratios.push_back(sum(seconds[who][r]) / sum(seconds.front()[r]));
        }
        timings.push_back({contenders[who].name,
                           sum(own) / static_cast<double>(pictures),
                           quartiles(std::move(ratios)),
                           sum(own) / sum(first),
                           quartiles(std::move(round_ratios))});
    }
    return timings;
}

std::string to_text(const std::vector<Timing>& timings) {
    std::string text =
        "  contender                                    us a picture  a second  ratio of "
        "sums  (rounds)             by picture: quartiles\n";
    for (const Timing& timing : timings) {
        char line[256];
        std::snprintf(
            line,
            sizeof line,
            "  %-44s %12.1f %9.0f %14.2f  (%.2f %.2f %.2f)      %5.2f %5.2f %5.2f\n",
            timing.name.c_str(),
            timing.seconds_a_picture * 1e6,
            1 / timing.seconds_a_picture,
            timing.total_ratio,
            timing.round_ratio.low,
            timing.round_ratio.median,
            timing.round_ratio.high,
            timing.ratio.low,
            timing.ratio.median,
            timing.ratio.high);
        text += line;
    }
    return text;
}

}  // namespace haarmony::bench
