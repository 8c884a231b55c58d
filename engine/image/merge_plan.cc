#include "engine/image/merge_plan.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>

#include "engine/image/segment_layout.h"

namespace haarmony::image {
namespace {

// Sizes 4^(t - 1) .. 4^t - 1 are class t.
int size_class(int live) { return (std::bit_width(static_cast<unsigned>(live)) + 1) / 2; }

}  // namespace

std::vector<std::size_t> plan_merge(std::span<const SegmentSize> segments) {
    std::map<int, std::vector<std::size_t>> classes;
    std::int64_t pictures = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (2 * segments[i].live <= segments[i].slots) return {i};
        pictures += segments[i].live;
        classes[size_class(segments[i].live)].push_back(i);
    }
    const auto most =
        std::clamp<std::int64_t>(pictures / 4, kSmallMerge, kMaxSegmentSlots);
    for (auto& [_, members] : classes) {
        if (members.size() < kMergeFanIn) continue;
        std::ranges::stable_sort(
            members, {}, [&](std::size_t i) { return segments[i].live; });
        std::int64_t total = 0;
        std::size_t count = 0;
        while (count < members.size() && total + segments[members[count]].live <= most) {
            total += segments[members[count++]].live;
        }
        if (count >= 2) return {members.begin(), members.begin() + std::ptrdiff_t(count)};
    }
    return {};
}

}  // namespace haarmony::image
