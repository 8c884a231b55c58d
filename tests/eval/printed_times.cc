#include "tests/eval/printed_times.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace haarmony::eval {
namespace {

struct PrintedTime {
    std::string_view metric;
    std::string_view resolution;
    double small_ms;
    double large_ms;
};

constexpr std::array<PrintedTime, 6> kTable = {{{"L^q", "m=20", 190, 440},
                                                {"L1", "8x8", 660, 7460},
                                                {"L2", "8x8", 680, 6390},
                                                {"L1", "128x128", 47'460, 892'600},
                                                {"L2", "128x128", 42'040, 790'800},
                                                {"histogram", "6x6x6", 470, 5030}}};

}  // namespace

std::optional<double> printed_ms(const MetricName& name, std::int64_t pictures) {
    const auto* const found = std::ranges::find_if(kTable, [&](const PrintedTime& row) {
        return row.metric == name.metric && row.resolution == name.resolution;
    });
    if (found == kTable.end()) return std::nullopt;
    if (pictures == kSmallDatabase) return found->small_ms;
    if (pictures == kLargeDatabase) return found->large_ms;
    return std::nullopt;
}

}  // namespace haarmony::eval
