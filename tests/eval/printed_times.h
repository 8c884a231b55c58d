// The times that the dissertation prints in Table 4.2, of an SGI Indy R4400.
//
// Units   milliseconds; L1 and L2 at 128 x 128 and 20,558 pictures were estimated.
// Source  sec. 4.5.5, Table 4.2.
#pragma once

#include <cstdint>
#include <optional>

#include "tests/eval/rival_metrics.h"

namespace haarmony::eval {

inline constexpr std::int64_t kSmallDatabase = 1093;
inline constexpr std::int64_t kLargeDatabase = 20558;

// Nothing for a metric or a size that the table does not have; L^q is that of m = 20.
[[nodiscard]] std::optional<double> printed_ms(const MetricName& name,
                                               std::int64_t pictures);

}  // namespace haarmony::eval
