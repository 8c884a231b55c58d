// One picture as the index takes it in.
#pragma once

#include "engine/core/ids.h"
#include "engine/image/signature.h"

namespace haarmony::image {

struct Record {
    ImageId id{};
    Signature signature;
};

}  // namespace haarmony::image
