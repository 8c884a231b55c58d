#include "tests/eval/speed_collection.h"

#include <algorithm>
#include <cstddef>

#include "tests/eval/picture_source.h"
#include "tests/eval/signature_cache.h"

namespace haarmony::eval {

Result<SmallPhotos> speed_photos(const SpeedOptions& options, Executor& executor) {
    if (options.photos.empty())
        return paint_small_photos(options.generated_photos, executor);
    const auto source = folder_source(options.photos);
    if (!source) return source.error();
    auto photos = load_small_photos(*source, executor);
    if (photos && photos->pictures.size() < 2) {
        return Error{ErrorCode::kInvalidArgument,
                     options.photos + ": one picture; two are the least"};
    }
    return photos;
}

Result<SyntheticCollection> speed_collection(
    const SpeedOptions& options,
    const SmallPhotos& photos,
    Executor& executor,
    const std::function<void(const std::string&)>& progress) {
    const std::int64_t images = options.images.back();
    const auto make = [&](int queries) {
        progress("making " + std::to_string(images) + " pictures");
        return make_synthetic_collection(
            photos, {options.seed, images, queries}, executor);
    };
    if (options.cache.empty()) return make(options.queries);
    auto cached = read_collection_cache(options.cache, images);
    const auto queries = static_cast<std::size_t>(options.queries);
    if (!cached) {
        progress(cached.error().message);
    } else if (cached->seed != options.seed || cached->source_digest != photos.digest ||
               cached->queries.front().size() < queries) {
        progress(options.cache + ": of another seed, of other photos or too few queries");
    } else {
        return cached;
    }
    SyntheticCollection made = make(static_cast<int>(
        std::min<std::int64_t>(kMostSpeedQueries, options.images.front())));
    const auto written = write_collection_cache(made, options.cache);
    if (!written) return written.error();
    return made;
}

}  // namespace haarmony::eval
