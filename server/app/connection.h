// A database connection with the stores that speak through it.
//
// Threads  one thread at a time: readers borrow from a ReadConnections pool, the one
//          writer is shared under a mutex (image_service.cc).
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "engine/core/result.h"
#include "schema/curve_store.h"
#include "schema/database.h"
#include "schema/duplicate_store.h"
#include "schema/feedback_store.h"
#include "schema/image_store.h"
#include "schema/job_store.h"
#include "schema/profile_store.h"
#include "schema/snapshot_store.h"
#include "schema/video_store.h"
#include "server/app/lending_pool.h"

namespace haarmony::server {

class Connection {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Connection>> open(
        const std::string& path,
        schema::Database::Mode mode) {
        Result<schema::Database> database = schema::Database::open(path, mode);
        if (!database) return std::move(database).error();
        return std::unique_ptr<Connection>(new Connection(std::move(database).value()));
    }

    [[nodiscard]] schema::Database& database() { return database_; }
    [[nodiscard]] schema::ImageStore& images() { return images_; }
    [[nodiscard]] schema::ProfileStore& profiles() { return profiles_; }
    [[nodiscard]] schema::FeedbackStore& feedback() { return feedback_; }
    [[nodiscard]] schema::JobStore& jobs() { return jobs_; }
    [[nodiscard]] schema::DuplicateStore& duplicates() { return duplicates_; }
    [[nodiscard]] schema::CurveStore& curves() { return curves_; }
    [[nodiscard]] schema::SnapshotStore& snapshots() { return snapshots_; }
    [[nodiscard]] schema::VideoStore& videos() { return videos_; }

  private:
    explicit Connection(schema::Database database)
        : database_(std::move(database)),
          images_(database_),
          profiles_(database_),
          feedback_(database_),
          jobs_(database_),
          duplicates_(database_),
          curves_(database_),
          snapshots_(database_),
          videos_(database_) {}

    schema::Database database_;
    schema::ImageStore images_;
    schema::ProfileStore profiles_;
    schema::FeedbackStore feedback_;
    schema::JobStore jobs_;
    schema::DuplicateStore duplicates_;
    schema::CurveStore curves_;
    schema::SnapshotStore snapshots_;
    schema::VideoStore videos_;
};

using ReadConnections = LendingPool<Connection>;

}  // namespace haarmony::server
