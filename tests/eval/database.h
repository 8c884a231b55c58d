// The pictures to be found, as every metric needs them.
//
// Shape   everything is indexed by the picture's place in the database; its id in a
//         search index is that place plus 1.
// Errors  kNotFound where there is no picture that can be read.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/image/index.h"
#include "engine/image/signature.h"
#include "tests/eval/picture_source.h"
#include "tests/eval/rival_metrics.h"

namespace haarmony::eval {

struct Database {
    std::vector<std::string> names;
    std::vector<std::size_t> source_places;  // of each picture, in its PictureSource
    std::vector<std::string> unreadable;     // "name: reason"
    std::vector<RivalFeatures> rivals;
    std::map<image::SignatureKind, std::vector<image::Signature>> signatures;

    [[nodiscard]] std::int64_t size() const {
        return static_cast<std::int64_t>(names.size());
    }
};

// Reads every picture once. Cost: 50 kB a picture for the full-size metrics.
[[nodiscard]] Result<Database> make_database(
    const PictureSource& source,
    const std::vector<image::SignatureKind>& kinds,
    Executor& executor);

[[nodiscard]] constexpr ImageId id_of(std::size_t place) {
    return ImageId{static_cast<std::int64_t>(place) + 1};
}

// The search index of signatures, sealed, with all their coefficients.
[[nodiscard]] std::unique_ptr<image::Index> make_index(
    const std::vector<image::Signature>& signatures);

}  // namespace haarmony::eval
