// Curves with names in the database: a library of characters, and strokes to be found.
//
// Shape    a name is one of its kind; `numbers` are rows of `dimension` of them.
// Errors   kNotFound for an unknown name; kInvalidArgument for a value that the table refuses
//          (a name other than 1 to 64 of a-z 0-9 _ -, a dimension not from 1 to 8, numbers
//          that are no rows of it); kIo for a row that is damaged; kUnavailable and kIo as in
//          image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

enum class CurveKind { kCharacter, kStroke };

struct StoredCurve {
    std::string name;
    bool closed = false;
    int dimension = 0;
    std::vector<double> numbers;
    // Given by the store; put() does not look at them.
    std::string updated_at;     // RFC 3339, UTC
    std::int64_t revision = 0;  // never used again, not even under another name
};

// What a list shows of a curve, for which its numbers need not be read.
struct ListedCurve {
    std::string name;
    bool closed = false;
    int dimension = 0;
    std::int64_t count = 0;  // of points
    std::string updated_at;
};

// Of a kind, to tell whether anything has changed: different after every put and remove.
struct CurvesVersion {
    std::int64_t last_put = 0;
    std::int64_t count = 0;

    friend bool operator==(const CurvesVersion&, const CurvesVersion&) = default;
};

class CurveStore {
  public:
    explicit CurveStore(Database& database) : cache_(database.handle()) {}

    // Inserts or replaces the curve of that kind and name.
    [[nodiscard]] Result<void> put(CurveKind kind, const StoredCurve& curve);
    [[nodiscard]] Result<StoredCurve> get(CurveKind kind, std::string_view name);
    // All, in the order of names.
    [[nodiscard]] Result<std::vector<StoredCurve>> list(CurveKind kind);
    // The first `limit` whose names come after `after`, in the order of names; "" is before all.
    // Requires: limit >= 0.
    [[nodiscard]] Result<std::vector<ListedCurve>> page(CurveKind kind,
                                                        std::string_view after,
                                                        int limit);
    [[nodiscard]] Result<void> remove(CurveKind kind, std::string_view name);
    [[nodiscard]] Result<CurvesVersion> version(CurveKind kind);

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
