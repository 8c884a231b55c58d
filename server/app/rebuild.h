// The search indexes from the database alone: every stored signature, in ranges of ids that
// several threads read and make segments of.
//   SQLite -> [rebuild.h] -> variant_indexes.h
//
// Errors   as ImageStore; kUnavailable where it was told to stop. A signature that does not
//          decode is none: it is told, and left out.
// Threads  any. Memory: a segment's pictures for each thread, 0.4 KB each at index_m = 60.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/packed_pictures.h"
#include "server/app/connection.h"
#include "server/app/variant_indexes.h"

namespace haarmony::server {

struct DamagedSignature {
    ImageId id{};
    std::string reason;
};

// The pictures of a range of ids, in their order. What was read before goes when a range is
// read, but for its memory: new memory is a sixth of the time.
class StoredPictures {
  public:
    // `most_in_piece`: at most what a segment holds.
    StoredPictures(int index_m, std::size_t most_in_piece)
        : index_m_(index_m), most_in_piece_(most_in_piece) {}

    // `most` is how many pictures are expected.
    [[nodiscard]] Result<void> read(schema::ImageStore& images,
                                    const schema::IdRange& range,
                                    std::size_t most,
                                    const std::function<bool()>& go_on);

    // All changes up to it are in; some later ones may be, too.
    [[nodiscard]] std::int64_t sequence() const { return sequence_; }
    [[nodiscard]] std::int64_t images() const { return images_; }
    [[nodiscard]] const std::vector<DamagedSignature>& damaged() const {
        return damaged_;
    }
    // Some pieces may be empty.
    using Pieces = std::deque<image::PackedPictures>;
    [[nodiscard]] const std::map<std::string, Pieces, std::less<>>& variants() const {
        return variants_;
    }

  private:
    void begin(std::size_t most);
    void add(const std::string& variant,
             const schema::SearchableImage& image,
             const image::Signature& signature);

    int index_m_;
    std::size_t most_in_piece_;
    std::int64_t sequence_ = 0;
    std::int64_t images_ = 0;
    std::map<std::string, Pieces, std::less<>> variants_;
    std::vector<DamagedSignature> damaged_;
};

// How many pictures to put into one segment, so that every thread has work and no segment is
// small without need.
[[nodiscard]] int pictures_per_segment(std::int64_t images, int threads);

struct Rebuilt {
    // Whoever applies the changes after it has what the database has.
    std::int64_t sequence = 0;
    std::int64_t images = 0;
    std::vector<DamagedSignature> damaged;
    SegmentsByVariant segments;
};

struct RebuildOptions {
    int index_m = 0;
    int threads = 1;              // that the executor has, the caller's included
    std::function<bool()> go_on;  // false: stop
};

[[nodiscard]] Result<Rebuilt> rebuild(ReadConnections& connections,
                                      const RebuildOptions& options,
                                      Executor& executor);

}  // namespace haarmony::server
