// The picture that costly requests carry.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace haarmony::bench {

// A JPEG of so many pixels of a made scene. kInvalidArgument naming a size that JPEG cannot
// have.
[[nodiscard]] Result<std::string> jpeg_picture(int width, int height);

}  // namespace haarmony::bench
