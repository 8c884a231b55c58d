#include "tests/engine/image/color_cube.h"

namespace haarmony::image {

std::unique_ptr<ColorPlanes> color_cube() {
    constexpr int kLevels = 25;
    auto planes = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kLevels * kLevels * kLevels; ++i) {
        (*planes)[0][i] = static_cast<float>(i % kLevels) / (kLevels - 1);
        (*planes)[1][i] = static_cast<float>(i / kLevels % kLevels) / (kLevels - 1);
        (*planes)[2][i] = static_cast<float>(i / kLevels / kLevels) / (kLevels - 1);
    }
    return planes;
}

std::unique_ptr<ColorPlanes> color_cube_edges() {
    constexpr int kSteps = 1024;
    auto planes = std::make_unique<ColorPlanes>();
    int place = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) {
            for (int step = 0; step <= kSteps; ++step, ++place) {
                (*planes)[axis][place] = static_cast<float>(step) / kSteps;
                (*planes)[(axis + 1) % 3][place] = static_cast<float>(corner % 2);
                (*planes)[(axis + 2) % 3][place] = static_cast<float>(corner / 2);
            }
        }
    }
    return planes;
}

}  // namespace haarmony::image
