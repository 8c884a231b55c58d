#include "tests/bench/http/picture.h"

#include "ingest/thumbnail.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::bench {

Result<std::string> jpeg_picture(int width, int height) {
    constexpr int kQuality = 90;
    constexpr unsigned kScene = 1;
    const image::Pixels scene = image::scene(width, height, kScene);
    const auto bytes = ingest::encode_jpeg(scene.view(), kQuality);
    if (!bytes) return bytes.error();
    return std::string(bytes->begin(), bytes->end());
}

}  // namespace haarmony::bench
