// From pairs of a query and what was meant by it to a stored profile:
//   feedback, JSON -> [profile_training] -> engine/image/training.h, profile_store
//
// The targets' signatures come from the collection, the mismatches are a sample of it.
//
// Errors  kConflict for a built-in name, and for a target without a signature of the base's
//         kind; kNotFound for a target that is not there; kInvalidArgument for an unknown base
//         ("base"), too few pairs and pairs that cannot be learned from ("pairs", "pairs[3]");
//         otherwise the stores'.
// Threads one thread a connection. A fit takes seconds: no lock is to be held meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "engine/image/strokes.h"
#include "engine/image/training.h"
#include "server/app/connection.h"

namespace haarmony::server {

// So many pairs can be learned from at once: half of them with a hundred mismatches each are
// the rows of the fit, 36 MB of them.
inline constexpr std::size_t kMaxTrainingPairs = 5'000;
inline constexpr std::size_t kMaxMismatches = 5'000;

// What was drawn or scanned, at least one of both, and the picture that was meant.
struct QueryPair {
    std::optional<image::Signature> signature;
    std::optional<image::StrokePicture>
        strokes;  // used where the signature is of another kind
    ImageId target{};
};

enum class Unusable { kRefused, kLeftOut };

struct ProfileFitOptions {
    std::string name;
    std::string base = "painted";
    Unusable unusable = Unusable::kRefused;  // pairs that cannot be learned from
    bool replace_worse = false;
    std::uint64_t seed = 1;  // of the sample, the split and the draw of mismatches
};

struct ProfileFit {
    image::TrainingReport report;
    std::size_t left_out = 0;  // pairs
    // Of the profile that has the name now; nothing where there is none, or where it compares
    // another kind of signature.
    std::optional<image::RankSummary> existing;
    std::optional<std::int64_t> existing_revision;
    // Worse than the base or than what has the name, or not comparable with it.
    bool worse = false;
};

[[nodiscard]] Result<ProfileFit> fit_profile(Connection& connection,
                                             const std::vector<QueryPair>& pairs,
                                             const ProfileFitOptions& options);

// Stores the fitted profile: where the name is free, or the fit is not worse, or a worse one
// is asked for. Returns whether it did; kConflict where the profile of that name is not the
// one that the fit was compared with, unless a worse one is asked for.
[[nodiscard]] Result<bool> store_fit(Connection& connection,
                                     const ProfileFit& fit,
                                     const ProfileFitOptions& options);

}  // namespace haarmony::server
