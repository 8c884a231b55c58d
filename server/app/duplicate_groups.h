// The pictures of the collection that are there more than once:
//   find_duplicates_job -> schema/duplicate_store -> [duplicate_groups] -> server/api
//
// Near and similar pictures are those that the last finished search for them found; files
// that are the same byte by byte are known at any moment.
//
// Errors  as DuplicateStore.
// Threads every member from any thread.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/duplicates.h"
#include "schema/image_store.h"
#include "server/app/connection.h"

namespace haarmony::server {

struct DuplicateQuery {
    image::DuplicateOptions least;
    int limit = 100;               // >= 1
    std::optional<ImageId> after;  // only groups whose first picture has an id above
};

struct FoundGroup {
    image::DuplicateGroup group;
    std::vector<schema::Image> images;  // the first kMaxImages of them
};

struct DuplicatePage {
    std::vector<FoundGroup> groups;  // by their first pictures
    bool more = false;
};

class DuplicateGroups {
  public:
    // So many pictures of a group are described.
    static constexpr std::size_t kMaxImages = 100;

    // The database must exist.
    [[nodiscard]] static Result<std::unique_ptr<DuplicateGroups>> open(
        const std::string& database_path);

    [[nodiscard]] Result<DuplicatePage> list(const DuplicateQuery& query);
    // The two are no duplicates, whatever later searches find.
    [[nodiscard]] Result<void> ignore(ImageId one, ImageId other);

  private:
    DuplicateGroups(const std::string& database_path, std::unique_ptr<Connection> writer);

    std::mutex writer_mutex_;  // guards writer_
    std::unique_ptr<Connection> writer_;
    ReadConnections readers_;
};

}  // namespace haarmony::server
