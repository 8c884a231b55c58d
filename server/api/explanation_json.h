// Why a match is as near as it is, for `explain=true`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/core/result.h"
#include "engine/image/profile.h"
#include "engine/image/signature.h"

namespace haarmony::server {

// {"channels": [{"channel", "average": {"query", "target", "weight"}, "distance",
//   "bins": [{"bin", "weight", "matched", "missed"}], "matched": [...], "missed": [...]}],
//  "picture": a data: URL}; signed indices as in the open form of a signature.
// Errors: kIo where the picture cannot be encoded.
[[nodiscard]] Result<nlohmann::json> explanation_json(const image::Signature& query,
                                                      const image::Signature& target,
                                                      const image::Profile& profile,
                                                      int m);

}  // namespace haarmony::server
