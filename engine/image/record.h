// One picture as the index takes it in.
#pragma once

#include <cstdint>

#include "engine/core/ids.h"
#include "engine/image/signature.h"

namespace haarmony::image {

struct Record {
    ImageId id{};
    Signature signature;
    std::int32_t log_aspect = 0;  // of width / height, fixed point: see aspect.h
};

}  // namespace haarmony::image
