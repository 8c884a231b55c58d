// What the parts of ImageStore share: the connection's statements and the words that the
// tables use for states and origins.
#pragma once

#include <cassert>
#include <string_view>

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

}  // namespace haarmony::schema
