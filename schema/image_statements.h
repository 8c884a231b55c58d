// What the parts of ImageStore share: the connection's statements and the words that the
// tables use for states and origins.
#pragma once

#include <cassert>
#include <string>
#include <string_view>
#include <vector>

#include "schema/image_store.h"
#include "schema/statement.h"
#include "schema/write_scope.h"

namespace haarmony::schema {

struct ImageStore::Statements {
    explicit Statements(sqlite3* database) : cache(database) {}

    // The scope of one writing function.
    [[nodiscard]] Result<WriteScope> write() {
        return WriteScope::begin(cache,
                                 in_transaction ? WriteScope::Kind::kSavepoint
                                                : WriteScope::Kind::kTransaction);
    }

    StatementCache cache;
    bool in_transaction = false;  // inside ImageStore::transaction()
};

[[nodiscard]] inline std::string_view word_of(ImageOrigin origin) {
    return origin == ImageOrigin::kFile ? "file" : "upload";
}

// The table allows no other words than these.
[[nodiscard]] inline ImageOrigin origin_of(std::string_view word) {
    return word == "file" ? ImageOrigin::kFile : ImageOrigin::kUpload;
}

[[nodiscard]] inline ImageState state_of(std::string_view word) {
    if (word == "indexed") return ImageState::kIndexed;
    return word == "failed" ? ImageState::kFailed : ImageState::kDeleted;
}

[[nodiscard]] inline Error no_such_image(ImageId id) {
    return Error{ErrorCode::kNotFound, "no image " + std::to_string(to_int(id)), "id"};
}

// Writing parts of a picture, inside the scope of the function that writes it.

// Steps a statement whose first parameter is the id of the row it is about, and which
// returns an id; whether there was such a row.
[[nodiscard]] Result<bool> wrote(StatementCache& cache, std::string_view sql, ImageId id);

// Those of `tags` that the picture does not have yet.
[[nodiscard]] Result<void> store_tags(StatementCache& cache,
                                      ImageId id,
                                      const std::vector<std::string>& tags);

[[nodiscard]] Result<void> store_variant(StatementCache& cache,
                                         ImageId id,
                                         const SignatureVariant& variant);

// Exactly `variants`. What stays the same is not written: it is no change to follow.
[[nodiscard]] Result<void> replace_variants(
    StatementCache& cache,
    ImageId id,
    const std::vector<SignatureVariant>& variants);

[[nodiscard]] inline std::string image_name(ImageId id) {
    return "image " + std::to_string(to_int(id));
}

}  // namespace haarmony::schema
