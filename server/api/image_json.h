// Pictures as the REST interface shows them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "schema/image_store.h"
#include "server/app/image_search.h"

namespace haarmony::server {

// One row, as GET /images and GET /images/{id} give it.
[[nodiscard]] nlohmann::json image_json(const schema::Image& image);

// Appends one match to a reply; `way` is how it was found, `rank` counts from 1,
// `explanation` is JSON, or empty for none.
void append_match(const FoundImage& found,
                  const PlannedWay& way,
                  const image::Profile& profile,
                  int rank,
                  std::string_view explanation,
                  std::string& reply);

// "/images/12", and with a part "/images/12/thumbnail".
[[nodiscard]] std::string image_address(ImageId id);
[[nodiscard]] std::string image_address(ImageId id, std::string_view part);

}  // namespace haarmony::server
