// The picture that an address names, as in /images/12.
#pragma once

#include <optional>
#include <string>

#include "engine/core/ids.h"
#include "schema/image_store.h"
#include "server/api/outcome.h"
#include "server/http/message.h"

namespace haarmony::server {

// The {id} of the address: 400 unless it is a whole number above 0.
[[nodiscard]] Outcome<ImageId> image_id_of(const http::Request& request);

// Strong, and another one whenever the row changes.
[[nodiscard]] std::string etag_of(const schema::Image& image);

// 400 naming the first query parameter, for addresses that take none.
[[nodiscard]] std::optional<http::Problem> refuse_parameters(
    const http::Request& request);

}  // namespace haarmony::server
