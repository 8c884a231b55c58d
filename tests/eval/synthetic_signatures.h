// A collection of synthetic pictures as the speed run needs it: their signatures, the compact
// descriptions of the rivals, and queries. Made from photos, so that some coefficients are as
// popular as they are in real collections (list_popularity.h measures it).
//
// Shape   picture i depends on the seed, the photos and i alone: a smaller collection is a
//         prefix of a larger one. Its id in an index is i + 1. The last tenth of the photos,
//         in a random order, is held out: no picture of the collection shows it.
// Threads made in parallel on an Executor; the result does not depend on how many threads.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "tests/eval/brute_force.h"
#include "tests/eval/packed_signature.h"
#include "tests/eval/small_photos.h"

namespace haarmony::eval {

// kNear: another variation of a picture that is in. kNovel: a picture of the held-out photos.
// kSketch: a painting in flat squares of a picture that is in.
enum class SyntheticKind { kNear, kNovel, kSketch };
inline constexpr std::array kSyntheticKinds = {SyntheticKind::kNear,
                                               SyntheticKind::kNovel,
                                               SyntheticKind::kSketch};

// "near", "novel" or "sketch".
[[nodiscard]] std::string synthetic_kind_name(SyntheticKind kind);

// How much is made, and from which seed.
struct SyntheticSize {
    std::uint64_t seed = 1;
    std::int64_t images = 0;
    int queries = 0;  // of each kind; near queries and sketches show the first pictures
};

struct SyntheticQuery {
    PackedSignature signature;
    CompactFeatures features;
    friend bool operator==(const SyntheticQuery&, const SyntheticQuery&) = default;
};

struct SyntheticCollection {
    std::uint64_t seed = 0;
    std::uint64_t source_digest = 0;  // of the photos
    std::vector<PackedSignature> signatures;
    std::vector<CellBytes> cells;
    std::vector<HistogramCounts> histograms;
    std::array<std::vector<SyntheticQuery>, kSyntheticKinds.size()> queries;

    [[nodiscard]] std::int64_t size() const {
        return static_cast<std::int64_t>(signatures.size());
    }
};

// Requires: two photos at least, 1 <= size.queries <= size.images. Cost: about 0.5 ms of one
// core and 1,000 bytes a picture.
[[nodiscard]] SyntheticCollection make_synthetic_collection(const SmallPhotos& photos,
                                                            const SyntheticSize& size,
                                                            Executor& executor);

}  // namespace haarmony::eval
