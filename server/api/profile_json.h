// Profiles in requests and replies:
//   {"name", "color_space", "decomposition", "m", "bin_rule", "weights": [[6 numbers] x 3],
//    "calibration": null or {"intercept", "scale"}}, and in replies "built_in", "indexed",
//   "updated_at" (null for a built-in one).
//
// Units   weights in the metric's unit, in [0, 10000], with at most two decimals.
// Errors  400 naming the member and the bad value, left in the Inputs.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/profile.h"
#include "schema/profile_store.h"
#include "server/api/inputs.h"

namespace haarmony::server {

// Three channels of six numbers.
[[nodiscard]] nlohmann::json weights_json(const image::Weights& weights);

// `indexed` is how many pictures can be searched under it. It shows a stored profile that the
// engine does not know as it is.
[[nodiscard]] nlohmann::json profile_json(const schema::StoredProfile& profile,
                                          bool built_in,
                                          std::int64_t indexed);

// 1 to 64 of a-z, 0-9, '_' and '-': what names profiles and kinds of feedback.
[[nodiscard]] bool is_word(std::string_view text);
// 400 for what can be no profile's name.
[[nodiscard]] std::optional<http::Problem> refuse_name(const std::string& name);

// The profile `name` that the members describe; what they leave out is that of `defaults`.
// A calibration belongs to one metric: it is taken over only where nothing else is given.
[[nodiscard]] image::Profile read_profile(Inputs& inputs,
                                          const std::string& name,
                                          const image::Profile& defaults);

}  // namespace haarmony::server
