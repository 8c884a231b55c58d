#include "tests/bench/video/by_turns.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace haarmony::video::bench {
namespace {

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

void measure_by_turns(const std::vector<Contender>& contenders,
                      std::int64_t items,
                      int rounds) {
    std::vector<std::vector<double>> seconds(contenders.size());
    for (int round = 0; round <= rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const double begin = thread_seconds();
            contenders[i].work();
            if (round > 0) seconds[i].push_back(thread_seconds() - begin);
        }
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        std::vector<double> ratios;
        for (std::size_t round = 0; round < seconds[i].size(); ++round) {
            ratios.push_back(seconds[i][round] / seconds[0][round]);
        }
        const double ratio = median(ratios);
        for (double& value : ratios) value = std::abs(value - ratio);
        std::printf("| %s | %.2f | %.3f | %.3f |\n",
                    contenders[i].name.c_str(),
                    median(seconds[i]) / double(items) * 1e9,
                    ratio,
                    median(ratios));
    }
}

void print_head(const std::string& item, const std::string& baseline) {
    std::printf(
        "| name | ns a %s | x %s | deviation |\n", item.c_str(), baseline.c_str());
    std::puts("|---|---|---|---|");
}

}  // namespace haarmony::video::bench
