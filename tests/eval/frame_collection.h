// Clips as a daemon keeps them for searches inside of them: built, signed, in a database, and
// asked by the daemon's own search.
//   video_clips.h -> [frame_collection.h] -> frame_retrieval.h
//
// Errors  of building and signing a clip, of the database and of the search.
// Threads one caller.
// Source  sec. 6.3, "Searching inside video".
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/profile.h"
#include "engine/video/clip_shape.h"
#include "schema/database.h"
#include "schema/video_store.h"
#include "server/app/frame_search.h"
#include "tests/eval/degrade.h"
#include "tests/eval/video_clips.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {

// The stretch of frames that matches best.
struct FoundFrames {
    std::int64_t video = 0;
    video::FrameRange frames;
    std::int64_t shot = 0;  // of the video
    double distance = 0;
};

class FrameCollection {
  public:
    [[nodiscard]] static Result<std::unique_ptr<FrameCollection>> make();

    // The video's id. Requires: a clip with frames.
    [[nodiscard]] Result<std::int64_t> add(const VideoClip& clip);

    // kNotFound where there is no frame at all.
    [[nodiscard]] Result<FoundFrames> best(const RgbPicture& picture,
                                           const image::Profile& profile,
                                           bool misregistered);

    // Of each frame of a video. Requires: a video that was added.
    [[nodiscard]] const std::vector<std::int64_t>& shots(std::int64_t video) const {
        return kept_.at(video).shots;
    }
    // Of all videos.
    [[nodiscard]] std::int64_t count_shots() const;
    [[nodiscard]] std::int64_t count_signatures() const { return signatures_; }

  private:
    struct Kept {
        video::ClipShape shape;
        std::vector<std::int64_t> shots;
    };

    using TemporaryFolder = haarmony::testing::TemporaryFolder;

    FrameCollection(std::unique_ptr<TemporaryFolder> folder, schema::Database database);

    std::unique_ptr<TemporaryFolder> folder_;  // outlives what is in it
    schema::Database database_;
    schema::VideoStore videos_{database_};
    std::unique_ptr<server::FrameSearch> search_;
    std::map<std::int64_t, Kept> kept_;
    std::int64_t signatures_ = 0;
};

}  // namespace haarmony::eval
