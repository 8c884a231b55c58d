// The service's options that are meant for a distortion, as further rows of the robustness
// table.
//
// Each asks in several ways, and a match counts at its best one.
//
// Threads const-safe.
// Source  sec. 4.6, "Affine transformation and partial queries".
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/image_view.h"
#include "engine/image/profile.h"
#include "tests/eval/ranking.h"

namespace haarmony::eval {

struct SearchOption {
    std::string name;                      // as a client sets it
    std::vector<std::string> distortions;  // the rows it is meant for
    // The queries that it asks with instead of one.
    std::function<std::vector<image::Query>(const ImageView&, const image::Profile&)>
        ways;
};

[[nodiscard]] const std::vector<SearchOption>& search_options();

// The target's rank when every way is asked.
[[nodiscard]] std::int64_t rank_with(const SearchOption& option,
                                     const WaveletSearch& search,
                                     const ImageView& query,
                                     const image::Profile& profile,
                                     std::size_t target);

}  // namespace haarmony::eval
