#include "tests/eval/metric_style.h"

#include "tests/eval/csv.h"

namespace haarmony::eval {

std::string metric_label(const MetricName& name, const std::string& profile) {
    return name.metric + ", " + name.resolution + (profile.empty() ? "" : ", " + profile);
}

PlotStyle metric_style(const MetricName& name, const std::string& profile) {
    const bool small = name.resolution == "8x8";
    if (name.metric == "L1") return {1, small ? 1 : 0};
    if (name.metric == "L2") return {2, small ? 1 : 0};
    if (name.metric == "histogram") return {3, 2};
    return {0, profile == "painted" ? 1 : 0};
}

std::string percent(const Rate& rate) { return number(100 * rate.share(), 1); }

std::string percent_with_interval(const Rate& rate) {
    const Interval interval = rate.interval();
    return percent(rate) + " (" + number(100 * interval.low, 1) + " to " +
           number(100 * interval.high, 1) + ')';
}

PlotPoint rate_point(double x, const Rate& rate) {
    const Interval interval = rate.interval();
    return {x, 100 * rate.share(), 100 * interval.low, 100 * interval.high};
}

}  // namespace haarmony::eval
