// A frame that was found, as a reply to a query shows it.
#pragma once

#include <string>

#include "server/app/frame_search.h"

namespace haarmony::server {

// One JSON object at the end of `reply`.
void append_frame_match(const FoundFrame& found,
                        const PlannedWay& way,
                        int rank,
                        std::string& reply);

}  // namespace haarmony::server
