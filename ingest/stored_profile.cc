#include "ingest/stored_profile.h"

#include <algorithm>
#include <string>
#include <utility>

namespace haarmony::ingest {
namespace {

Error not_understood(const schema::StoredProfile& stored, const std::string& complaint) {
    return Error{ErrorCode::kInvalidArgument,
                 "the stored profile '" + stored.name + "' " + complaint,
                 "profile"};
}

}  // namespace

schema::StoredProfile to_stored(const image::Profile& profile) {
    schema::StoredProfile stored;
    stored.name = profile.name;
    stored.color_space = image::color_space_name(profile.kind.color_space);
    stored.decomposition = image::decomposition_name(profile.kind.decomposition);
    stored.m = profile.m;
    stored.bin_rule = image::bin_rule_name(profile.bin_rule);
    stored.weights = profile.weights;
    if (profile.calibration) {
        stored.calibration = {profile.calibration->intercept, profile.calibration->scale};
    }
    return stored;
}

Result<image::Profile> from_stored(const schema::StoredProfile& stored) {
    const auto space = image::color_space_from_name(stored.color_space);
    if (!space)
        return not_understood(stored, "has the color space '" + stored.color_space + "'");
    const auto decomposition = image::decomposition_from_name(stored.decomposition);
    if (!decomposition)
        return not_understood(stored,
                              "has the decomposition '" + stored.decomposition + "'");
    const auto rule = image::bin_rule_from_name(stored.bin_rule);
    if (!rule)
        return not_understood(stored, "has the bin rule '" + stored.bin_rule + "'");
    if (stored.m < 1 || stored.m > image::kMaxCoefficients)
        return not_understood(stored, "has m = " + std::to_string(stored.m));
    for (const auto& channel : stored.weights) {
        for (const std::int32_t weight : channel) {
            if (weight < 0 || weight > image::kMaxWeight)
                return not_understood(
                    stored, "has a weight of " + std::to_string(weight) + " / 100");
        }
    }
    image::Profile profile;
    profile.name = stored.name;
    profile.kind = {*space, *decomposition};
    profile.m = stored.m;
    profile.bin_rule = *rule;
    profile.weights = stored.weights;
    if (stored.calibration) {
        profile.calibration = {stored.calibration->first, stored.calibration->second};
    }
    return profile;
}

Result<image::Profile> find_profile(schema::ProfileStore& store, std::string_view name) {
    if (auto profile = image::built_in_profile(name)) return *std::move(profile);
    const Result<schema::StoredProfile> stored = store.get(name);
    if (!stored) return stored.error();
    return from_stored(stored.value());
}

Result<std::vector<image::SignatureKind>> kinds_in_use(schema::ProfileStore& store) {
    const Result<std::vector<schema::StoredProfile>> profiles = store.list();
    if (!profiles) return profiles.error();
    std::vector<image::SignatureKind> kinds = {{}};
    for (const schema::StoredProfile& stored : profiles.value()) {
        const Result<image::Profile> profile = from_stored(stored);
        if (profile && std::ranges::find(kinds, profile->kind) == kinds.end())
            kinds.push_back(profile->kind);
    }
    return kinds;
}

}  // namespace haarmony::ingest
