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
    // What it asks with: the signatures of the query, one a way.
    std::function<std::vector<image::Signature>(const ImageView&,
                                                const image::SignatureKind&)>
        ways;
    bool equal_weights = false;  // every way weighs what the first one does
};

[[nodiscard]] const std::vector<SearchOption>& search_options();

// The target's rank when every way is asked. Requires: ways of the profile's kind, one at
// least.
[[nodiscard]] std::int64_t rank_with(const SearchOption& option,
                                     const std::vector<image::Signature>& ways,
                                     const WaveletSearch& search,
                                     const image::Profile& profile,
                                     std::size_t target);

}  // namespace haarmony::eval
