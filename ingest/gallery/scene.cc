#include "ingest/gallery/scene.h"

#include <vector>

namespace haarmony::gallery {

Scene begin_scene(Canvas& canvas,
                  Commission& commission,
                  int scenes,
                  std::initializer_list<Hour> hours,
                  double low,
                  double high) {
    Random& random = commission.random;
    const std::vector<Hour> choices(hours);
    const auto turn = static_cast<std::size_t>(commission.turn / scenes);
    const Hour hour = choices[turn % choices.size()];
    const double horizon = random.between(low, high);
    Scene scene{canvas,
                random,
                commission.hue,
                make_sky(random, hour, canvas.aspect(), horizon),
                horizon};
    paint_sky(canvas, scene.sky, horizon, random);
    return scene;
}

}  // namespace haarmony::gallery
