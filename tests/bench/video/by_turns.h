// Several ways to do the same, timed in turns by the processor time of the thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace haarmony::video::bench {

struct Contender {
    std::string name;
    std::function<void()> work;
};

// Prints a row for each: nanoseconds an item, the median of the paired ratios to the first
// contender, and the median distance from it. The first round only warms.
void measure_by_turns(const std::vector<Contender>& contenders,
                      std::int64_t items,
                      int rounds);

void print_head(const std::string& item, const std::string& baseline);

}  // namespace haarmony::video::bench
