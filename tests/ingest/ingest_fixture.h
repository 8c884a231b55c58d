// Folders of real pictures and the real haarmony-ingest on them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "schema/image_store.h"
#include "tests/ingest/child_process.h"
#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {

// A JPEG that no other `number` gives.
[[nodiscard]] std::string jpeg_of(int number, int width, int height);

// All of a row that does not depend on when it was written.
struct StoredRow {
    std::int64_t id = 0;
    schema::ImageState state = schema::ImageState::kIndexed;
    std::string content_hash;
    std::int64_t size = 0;
    std::int64_t mtime_ns = 0;
    int width = 0;
    int height = 0;
    std::string media_type;
    std::vector<std::uint8_t> signature;
    std::vector<std::uint8_t> thumbnail;

    [[nodiscard]] StoredRow without_id() const {
        StoredRow row = *this;
        row.id = 0;
        return row;
    }
    friend bool operator==(const StoredRow&, const StoredRow&) = default;
};

class IngestFixture : public testing::Test {
  protected:
    // --db is put before the arguments.
    [[nodiscard]] std::vector<std::string> command(
        const std::vector<std::string>& arguments) const;
    [[nodiscard]] Finished ingest(const std::vector<std::string>& arguments,
                                  const ChildOptions& options = {}) const;
    // The pictures, quietly: the done line and the exit code.
    void expect_ingested(const std::string& counts, int status = 0) const;

    // By path; empty when there is no database yet.
    [[nodiscard]] std::map<std::string, StoredRow> rows(
        const std::string& database) const;
    [[nodiscard]] std::map<std::string, StoredRow> rows() const {
        return rows(database_);
    }
    void remove_row(const std::string& path) const;

    const ScratchFolder folder_;
    const std::string pictures_ = folder_.make_folder("pictures");
    const std::string database_ = folder_ / "haarmony.db";
};

// "done: COUNTS seconds=..." as the last line of `out`.
[[nodiscard]] std::string counts_of(const std::string& out);
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace haarmony::ingest
