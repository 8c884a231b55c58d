#include "engine/image/color_space.h"

namespace haarmony::image {

//   Y = 0.299000 R + 0.587000 G + 0.114000 B
//   I = 0.595716 R - 0.274453 G - 0.321263 B
//   Q = 0.211456 R - 0.522591 G + 0.311135 B
// The rows add up to 1, 0 and 0, which is what lets G be taken out of each.
void rgb_to_yiq(ColorPlanes& planes) {
    float* const first = planes[0].data();
    float* const second = planes[1].data();
    float* const third = planes[2].data();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float green = second[i];
        const float red = first[i] - green;
        const float blue = third[i] - green;
        first[i] = green + (0.299F * red + 0.114F * blue);
        second[i] = 0.595716F * red - 0.321263F * blue;
        third[i] = 0.211456F * red + 0.311135F * blue;
    }
}

}  // namespace haarmony::image
