// Searches inside videos: an index of the frames that have signatures, which follows the
// database, and answers of shots instead of frames.
//
//   query_picture, profiles -> search_plan -> [frame_search] -> schema/video_store
//
// Neighbouring frames look alike, so a list of frames would be a list of one shot: of each
// shot only its best match is told (frame_signatures.h says what a shot is).
//
// Errors   as SearchPlan::make(); kConflict for a profile of another kind than the frames'
//          signatures; the store's.
// Threads  every member from any thread. The index is brought up to date by the first search
//          that finds it behind; the others wait for that.
// Source   sec. 6.3, "Searching inside video".
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/index.h"
#include "schema/video_store.h"
#include "server/app/connection.h"
#include "server/app/search_plan.h"

namespace haarmony::server {

struct FoundFrame {
    std::int64_t id = 0;  // of the frame's row
    schema::Video video;
    int time_level = 0;
    std::int64_t node = 0;
    Candidate match;
};

struct FrameMatches {
    SearchPlan plan;
    std::vector<FoundFrame> frames;  // best first, of each shot one
    std::int64_t searched = 0;
    std::chrono::nanoseconds ranking{};
};

class FrameSearch {
  public:
    FrameSearch(const std::string& database_path, int index_m);

    // The best matches of at most `limit` shots. Requires: limit >= 1.
    [[nodiscard]] Result<FrameMatches> search(const QueryPicture& picture,
                                              const PlanOptions& options,
                                              int limit);
    // How many frames can be found.
    [[nodiscard]] Result<std::int64_t> count();

  private:
    struct Place {
        std::int64_t video = 0;
        int time_level = 0;
        std::int64_t node = 0;
        std::int64_t shot = 0;
    };
    using Places = std::map<std::int64_t, Place>;

    // The index and the places that belong to it.
    struct Snapshot {
        std::shared_ptr<const image::IndexSnapshot> index;
        std::shared_ptr<const Places> places;
    };

    [[nodiscard]] Result<Snapshot> follow();
    [[nodiscard]] Result<void> take_new(schema::VideoStore& videos, Places& places);
    [[nodiscard]] Result<void> drop_gone(schema::VideoStore& videos, Places& places);

    ReadConnections readers_;
    std::mutex mutex_;  // guards the rest
    image::Index index_;
    std::shared_ptr<const Places> places_ = std::make_shared<Places>();
    std::int64_t last_ = 0;  // the largest id that was read
};

}  // namespace haarmony::server
