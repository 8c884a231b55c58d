// Signatures in requests and replies: the opaque text, or the open form
// {"average": [Y, I, Q], "coefficients": [[...], [...], [...]], "kind": "yiq-standard"};
// without "kind" it is of that kind.
//
// Errors  kInvalidArgument naming the member and the bad value.
// Threads const-safe.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/core/result.h"
#include "engine/image/signature.h"

namespace haarmony::server {

// Both forms in one object, with "low_information": what GET /images/{id}/signature gives.
[[nodiscard]] nlohmann::json signature_json(const image::Signature& signature);

// Takes a string, an open form, and also the whole object that signature_json() makes;
// there the two forms must agree.
[[nodiscard]] Result<image::Signature> parse_signature(const nlohmann::json& value);

}  // namespace haarmony::server
