// Profiles between the engine, which uses them, and the database, which keeps them.
//
// Errors  a stored profile that says what the engine does not know is kInvalidArgument,
//         naming profile and value.
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/profile.h"
#include "schema/profile_store.h"

namespace haarmony::ingest {

[[nodiscard]] schema::StoredProfile to_stored(const image::Profile& profile);
[[nodiscard]] Result<image::Profile> from_stored(const schema::StoredProfile& stored);

// A built-in profile or a stored one; kNotFound naming it.
[[nodiscard]] Result<image::Profile> find_profile(schema::ProfileStore& store,
                                                  std::string_view name);

// The kinds of signature that some profile compares, the default one first, each once: what
// is made of every new picture. A stored profile that is not understood asks for nothing.
[[nodiscard]] Result<std::vector<image::SignatureKind>> kinds_in_use(
    schema::ProfileStore& store);

}  // namespace haarmony::ingest
