// Where an evaluation takes its pictures from.
//
// Errors  of load(): those of decode.h and of reading a file.
// Threads load() may be called from several threads at once.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "tests/eval/degrade.h"

namespace haarmony::eval {

struct PictureSource {
    std::vector<std::string> names;
    std::function<Result<RgbPicture>(std::size_t)> load;  // by index into `names`
};

// The files below a folder, in the order of their paths; alpha over white.
// Errors: kNotFound for a folder that cannot be read.
[[nodiscard]] Result<PictureSource> folder_source(const std::string& folder);

}  // namespace haarmony::eval
