// Whatever the bytes: a type or none, dimensions or an error, an orientation in 1..8.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "ingest/dimensions.h"
#include "ingest/orientation.h"
#include "ingest/sniff.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace haarmony::ingest;
    const std::span<const std::uint8_t> input(bytes, size);
    const auto type = sniff(input);
    // Every parser sees every input: the corpus of one format serves the others.
    for (const FormatDescription& entry : formats()) {
        const auto dimensions = read_dimensions(entry.format, input);
        if (dimensions &&
            (dimensions->width < 1 || dimensions->height < 1 ||
             dimensions->width > 0x7fffffff || dimensions->height > 0x7fffffff)) {
            std::abort();
        }
        const int orientation = exif_orientation(entry.format, input);
        if (orientation < 1 || orientation > 8) std::abort();
    }
    if (type && type->format &&
        describe_format(*type->format).media_type != type->media_type) {
        std::abort();
    }
    return 0;
}
