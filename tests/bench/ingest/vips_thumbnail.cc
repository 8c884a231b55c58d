#include "tests/bench/ingest/vips_thumbnail.h"

#ifdef HAARMONY_WITH_VIPS

#include <vips/vips.h>

#include <memory>

#include "engine/image/signature.h"

namespace haarmony::bench {
namespace {

std::string error_text() {
    std::string text = vips_error_buffer();
    vips_error_clear();
    return text.empty() ? "libvips gave no reason" : text;
}

struct Unreference {
    void operator()(VipsImage* image) const { g_object_unref(image); }
};
struct Free {
    void operator()(void* memory) const { g_free(memory); }
};
using Image = std::unique_ptr<VipsImage, Unreference>;

}  // namespace

bool start_vips() {
    if (VIPS_INIT("haarmony-bench-ingest") != 0) return false;
    vips_concurrency_set(1);
    // Its cache would answer the second round from memory.
    vips_cache_set_max(0);
    return true;
}

std::string sign_with_vips_thumbnail(std::span<const std::uint8_t> bytes) {
    VipsImage* made = nullptr;
    // The bytes are only read; the interface predates const.
    if (vips_thumbnail_buffer(const_cast<std::uint8_t*>(bytes.data()),
                              bytes.size(),
                              &made,
                              image::kSide,
                              "height",
                              image::kSide,
                              "size",
                              VIPS_SIZE_FORCE,
                              nullptr) != 0) {
        return error_text();
    }
    const Image thumbnail(made);
    std::size_t size = 0;
    const std::unique_ptr<void, Free> pixels(
        vips_image_write_to_memory(thumbnail.get(), &size));
    if (!pixels) return error_text();
    const ImageView view = {static_cast<const std::uint8_t*>(pixels.get()),
                            vips_image_get_width(thumbnail.get()),
                            vips_image_get_height(thumbnail.get()),
                            vips_image_get_bands(thumbnail.get()),
                            std::ptrdiff_t{vips_image_get_width(thumbnail.get())} *
                                vips_image_get_bands(thumbnail.get())};
    static_cast<void>(image::make_signature(view));
    return {};
}

}  // namespace haarmony::bench

#else

namespace haarmony::bench {

bool start_vips() { return false; }

std::string sign_with_vips_thumbnail(std::span<const std::uint8_t>) {
    return "built without libvips";
}

}  // namespace haarmony::bench

#endif
