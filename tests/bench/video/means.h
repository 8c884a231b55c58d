// What the exact means of a clip cost, for each pixel of its source.
#pragma once

#include <string>

namespace haarmony::video::bench {

struct MeansOptions {
    int width = 768;
    int height = 432;
    int rounds = 15;
};

// False where the plain mean is another.
[[nodiscard]] bool measure_means(const MeansOptions& options);

}  // namespace haarmony::video::bench
