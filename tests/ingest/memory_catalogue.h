// The database as a map: what a run leaves behind, and a way to make any step of it fail.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ingest/catalogue.h"

namespace haarmony::ingest {

class MemoryCatalogue final : public Catalogue {
  public:
    struct Row {
        schema::KnownFile known;
        schema::NewImage image;
        std::string failure;
    };
    using Rows = std::map<std::string, Row>;  // by uri

    // Counted from 1; 0: none fails.
    int failing_transaction = 0;
    int failing_lookup = 0;
    int failing_key_frame_lookup = 0;
    std::function<void()> before_transaction = [] {};

    std::vector<int> operations_per_transaction;
    int touches = 0;

    Rows rows() const {
        const std::lock_guard lock(mutex_);
        return rows_;
    }
    void put(const std::string& uri, Row row) {
        const std::lock_guard lock(mutex_);
        last_id_ = std::max(last_id_, to_int(row.known.id));
        rows_[uri] = std::move(row);
    }

    Result<std::optional<schema::KnownFile>> look_up(const std::string& uri) override {
        const std::lock_guard lock(mutex_);
        ++lookups_;
        looked_up_.notify_all();
        if (lookups_ == failing_lookup) return failure("lookup");
        return find(uri);
    }
    Result<std::vector<FilmRow>> look_up_key_frames(const std::string& uri) override {
        std::vector<FilmRow> found;
        for (const auto& [row_uri, row] : rows()) {
            if (row_uri.starts_with(uri + "#t=")) found.push_back({row.known, row_uri});
        }
        const std::lock_guard lock(mutex_);
        if (++key_frame_lookups_ == failing_key_frame_lookup)
            return failure("lookup of key frames");
        return found;
    }
    void wait_for_lookups(int count) {
        std::unique_lock lock(mutex_);
        EXPECT_TRUE(looked_up_.wait_for(
            lock, std::chrono::seconds(60), [&] { return lookups_ >= count; }));
    }

    Result<void> transaction(const std::function<Result<void>()>& work) override {
        before_transaction();
        const Rows before = rows();
        operations_ = 0;
        Result<void> done = work();
        if (done && ++transactions_ == failing_transaction) done = failure("transaction");
        if (done) {
            operations_per_transaction.push_back(operations_);
        } else {
            const std::lock_guard lock(mutex_);
            rows_ = before;
        }
        return done;
    }

    Result<std::optional<schema::KnownFile>> known_file(const std::string& uri) override {
        const std::lock_guard lock(mutex_);
        return find(uri);
    }
    Result<void> add(const schema::NewImage& image) override {
        const std::lock_guard lock(mutex_);
        ++operations_;
        const ImageId id{++last_id_};
        rows_[image.uri] = {{id, schema::ImageState::kIndexed, image.stamp}, image, {}};
        return {};
    }
    Result<void> update(ImageId id, const schema::NewImage& image) override {
        const std::lock_guard lock(mutex_);
        ++operations_;
        rows_.at(uri_of(id)) = {
            {id, schema::ImageState::kIndexed, image.stamp}, image, {}};
        return {};
    }
    Result<void> touch(ImageId id, const schema::FileStamp& stamp) override {
        const std::lock_guard lock(mutex_);
        ++operations_;
        ++touches;
        rows_.at(uri_of(id)).known.stamp = stamp;
        return {};
    }
    Result<void> mark_failed(const std::string& uri,
                             const schema::FileStamp& stamp,
                             const std::string& reason) override {
        const std::lock_guard lock(mutex_);
        ++operations_;
        const auto found = rows_.find(uri);
        const ImageId id =
            found != rows_.end() ? found->second.known.id : ImageId{++last_id_};
        rows_[uri] = {{id, schema::ImageState::kFailed, stamp}, {}, reason};
        return {};
    }
    Result<void> purge(ImageId id) override {
        const std::lock_guard lock(mutex_);
        ++operations_;
        const std::string uri = uri_of(id);
        if (uri.empty()) return Error{ErrorCode::kNotFound, "no such row", {}};
        rows_.erase(uri);
        return {};
    }
    Result<void> for_each_file(
        const std::string& uri_prefix,
        const std::function<void(const schema::KnownFile&, const std::string& uri)>&
            visit) override {
        for (const auto& [uri, row] : rows()) {
            if (uri.starts_with(uri_prefix)) visit(row.known, uri);
        }
        return {};
    }

  private:
    static Error failure(const std::string& what) {
        return {ErrorCode::kIo, "forced failure of a " + what, {}};
    }
    std::optional<schema::KnownFile> find(const std::string& uri) const {
        const auto found = rows_.find(uri);
        if (found == rows_.end()) return std::nullopt;
        return found->second.known;
    }
    std::string uri_of(ImageId id) const {
        for (const auto& [uri, row] : rows_) {
            if (row.known.id == id) return uri;
        }
        return {};
    }

    mutable std::mutex mutex_;
    std::condition_variable looked_up_;
    Rows rows_;
    std::int64_t last_id_ = 0;
    int lookups_ = 0;
    int key_frame_lookups_ = 0;
    int transactions_ = 0;
    int operations_ = 0;
};

}  // namespace haarmony::ingest
