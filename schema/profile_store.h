// Search profiles in the database: what a signature is made of and how its parts weigh.
//
// Shape    weights: three channels of six bins, in the engine's fixed-point unit; this folder
//          does not understand any value of a profile but its name.
// Errors   kNotFound for an unknown name; kInvalidArgument for a value that the table refuses
//          (a name other than 1 to 64 of a-z 0-9 _ -, an m below 1, a calibration that is not
//          finite); kUnavailable and kIo as in image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

using ProfileWeights = std::array<std::array<std::int32_t, 6>, 3>;

struct StoredProfile {
    std::string name;
    std::string color_space;
    std::string decomposition;
    int m = 0;
    std::string bin_rule;
    ProfileWeights weights{};
    std::optional<std::pair<double, double>> calibration;  // intercept, scale
    // Given by the store; put() does not look at them.
    std::string updated_at;  // RFC 3339, UTC
    std::int64_t revision =
        0;  // never used again, not even under another name: for ETags
};

class ProfileStore {
  public:
    explicit ProfileStore(Database& database) : cache_(database.handle()) {}

    // Inserts or replaces the profile of that name.
    [[nodiscard]] Result<void> put(const StoredProfile& profile);
    [[nodiscard]] Result<StoredProfile> get(std::string_view name);
    // All, in the order of names.
    [[nodiscard]] Result<std::vector<StoredProfile>> list();
    [[nodiscard]] Result<void> remove(std::string_view name);

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
