// From pairs of pictures that resemble each other to groups of duplicates:
//   symmetric_metric.h -> [duplicates.h]
//
// Three levels, never conflated: the same bytes; the same picture in other bytes (another
// size, compression or brightness, a sliver cut off); and pictures that a person might
// take for variants of one (a wider crop, a scan).
//
// Units   a similarity is mutual_similarity() with duplicate_profile().
// Errors  none; a pair of a picture with itself is a caller's bug and asserts.
// Source  ours. Pictures with next to no information: ARCHITECTURE.md ("Errata").
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/profile.h"

namespace haarmony::image {

enum class DuplicateLevel { kSimilar = 1, kNear = 2, kExact = 3 };  // weakest first

// "exact", "near" or "similar".
[[nodiscard]] std::string_view duplicate_level_name(DuplicateLevel level);
[[nodiscard]] std::optional<DuplicateLevel> duplicate_level_from_name(
    std::string_view name);

// Measured on 900 photographs with duplicate_profile(), 404,550 unrelated pairs: the most
// similar one has 0.498, 99 % of the photographs have none above 0.42. Half and a quarter
// of the size, JPEG quality 75 and 30, 0.9 of the brightness, and 1 % or 2 % cut from each
// side: at least 99.8 % have 0.60. With 5 % cut off, and of poor scans, 99 % have 0.45.
inline constexpr double kNearSimilarity = 0.60;
inline constexpr double kSimilarSimilarity = 0.45;

// What duplicates are compared with: the weights of "scanned" with 60 coefficients, which
// set copies further apart from the rest than 40 or 20 and than the weights of "painted".
[[nodiscard]] Profile duplicate_profile();

struct Resemblance {
    double similarity = 0;
    bool same_bytes = false;
    bool low_information = false;  // of either picture
};

// Nothing where the pictures are no duplicates. Pictures of low information are exact
// duplicates or none.
[[nodiscard]] std::optional<DuplicateLevel> level_of(const Resemblance& resemblance);

struct DuplicatePair {
    ImageId a{};
    ImageId b{};
    DuplicateLevel level = DuplicateLevel::kSimilar;
    double similarity = 0;
};

// Of the pairs that connect the group, those are meant that hold it together best: a group
// of three copies is not weaker for a fourth, weaker pair among them.
struct DuplicateGroup {
    std::vector<ImageId> ids;                       // rising, at least two
    DuplicateLevel level = DuplicateLevel::kExact;  // the weakest that is needed
    double similarity = 0;                          // the lowest that is needed
    friend bool operator==(const DuplicateGroup&, const DuplicateGroup&) = default;
};

struct DuplicateOptions {
    double min_similarity = 0;  // pairs below it do not connect
    DuplicateLevel min_level = DuplicateLevel::kSimilar;
};

// Groups are the connected components over the pairs that are neither ignored ("not a
// duplicate", in either order) nor below the options; sorted by their smallest id. The order
// of the pairs does not matter, and a pair given twice counts with its better level.
// An ignored pair may still meet in a group that others connect.
[[nodiscard]] std::vector<DuplicateGroup> group_duplicates(
    std::span<const DuplicatePair> pairs,
    std::span<const std::pair<ImageId, ImageId>> ignored,
    const DuplicateOptions& options);

}  // namespace haarmony::image
