// A decomposed curve in JSON: {"coarse", "details", "frame", "closed"}.
//
// Errors   as points_json.h; 422 for rows that no level has.
// Threads  values.
#pragma once

#include "engine/curve/frame.h"
#include "server/api/curve_json.h"

namespace haarmony::server {

[[nodiscard]] Outcome<curve::LocalDetails> read_details(Inputs& inputs,
                                                        curve::Frame frame,
                                                        curve::Ends ends);

void add_details(JsonObject& object, const curve::LocalDetails& details);

}  // namespace haarmony::server
