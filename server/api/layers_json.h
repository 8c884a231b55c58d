// The layers of a composition in JSON, and the pixels of those that are still pictures.
//
// Shape    {"video": id} or {"image": id or base64}, "translate": [dx, dy], "at_level",
//          "scale": [sx, sy], "start", "op"; all but the first may be left out. A stored
//          image is its original below a media root, else its thumbnail: nothing else of an
//          upload is kept.
// Errors   as video_compose.h.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/app/composition_request.h"

namespace haarmony::server {

struct LayersIn {
    std::vector<LayerRequest> layers;
    std::vector<std::byte> stills;  // straight RGBA, one after the other
};

[[nodiscard]] Outcome<LayersIn> read_layers(const Context& context,
                                            const nlohmann::json& layers);

}  // namespace haarmony::server
