#include "tests/bench/http/cached_rows.h"

#include "tests/bench/http/synthetic_rows.h"
#include "tests/eval/packed_signature.h"
#include "tests/eval/signature_cache.h"

namespace haarmony::bench {

Result<void> write_cached_rows(const std::string& database,
                               std::int64_t images,
                               const std::string& cache) {
    const auto collection = eval::read_signature_cache(cache);
    if (!collection) return collection.error();
    if (collection->size() < images)
        return Error{ErrorCode::kInvalidArgument,
                     cache + ": " + std::to_string(collection->size()) +
                         " pictures, not " + std::to_string(images)};
    return write_rows(database, images, [&](std::int64_t number) {
        return eval::unpack(collection->signatures[static_cast<std::size_t>(number - 1)]);
    });
}

}  // namespace haarmony::bench
