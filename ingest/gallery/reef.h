// A coral reef under water: the seascape that has no sky.
//
// Units   as painters.h.
// Threads const-safe.
#pragma once

#include "ingest/gallery/painters.h"

namespace haarmony::gallery {

[[nodiscard]] Label paint_reef(Canvas& canvas, Commission& commission);

}  // namespace haarmony::gallery
