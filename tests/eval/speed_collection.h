// The pictures of a speed run: photos, and the synthetic collection that is made of them.
//
// Errors  as measure_speed() in speed.h.
#pragma once

#include <functional>
#include <string>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "tests/eval/small_photos.h"
#include "tests/eval/speed.h"
#include "tests/eval/synthetic_signatures.h"

namespace haarmony::eval {

// Of the folder, or generated ones.
[[nodiscard]] Result<SmallPhotos> speed_photos(const SpeedOptions& options,
                                               Executor& executor);

// From the cache where it holds what is asked for, else made, and kept in it.
[[nodiscard]] Result<SyntheticCollection> speed_collection(
    const SpeedOptions& options,
    const SmallPhotos& photos,
    Executor& executor,
    const std::function<void(const std::string&)>& progress);

}  // namespace haarmony::eval
