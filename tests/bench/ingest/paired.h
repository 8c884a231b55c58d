// Several ways of doing the same work, measured in turns on one picture after the other, so
// that whatever else the machine does meets all of them alike.
//
// Units   seconds of processor time of the whole process: a contender that starts threads
//         pays for them.
// Scale   a ratio is another contender's time divided by the first one's, picture by
//         picture: above 1 where the first is faster.
// Threads one thread measures.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace haarmony::bench {

[[nodiscard]] double process_seconds();

struct Quartiles {
    double low = 0;
    double median = 0;
    double high = 0;
};

// Requires: not empty.
[[nodiscard]] Quartiles quartiles(std::vector<double> values);

struct Contender {
    std::string name;
    std::function<void(std::size_t picture)> work;
};

struct Timing {
    std::string name;
    double seconds_a_picture = 0;  // mean over pictures of the fastest round
    Quartiles ratio;               // to the first contender, over pictures
    double total_ratio = 0;        // of the sums over all pictures
    Quartiles round_ratio;         // of the sums, over rounds
};

// The order of the contenders changes from picture to picture. Requires: at least one
// contender, one picture and one round. Cost: one warming round more than `rounds`.
[[nodiscard]] std::vector<Timing> measure_in_turns(
    const std::vector<Contender>& contenders,
    std::size_t pictures,
    int rounds);

// One line a contender, the pictures a second of one core first.
[[nodiscard]] std::string to_text(const std::vector<Timing>& timings);

}  // namespace haarmony::bench
