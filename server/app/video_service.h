// The videos: rows of the database and the clips in their files, opened when they are asked
// for.
//
//   server/api/video* -> [video_service] -> schema/video_store, engine/video/mrv_clip
//   video_job -> [video_service]
//
// A clip that somebody looks at stays readable until he lets go of it, also when the video
// is removed or grows meanwhile. Layers are decoded when they are asked for, and kept while
// there is room for them.
//
// Errors   the store's; kUndecodable for a file that is damaged, kIo for one that is gone.
// Threads  every member from any thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/time_tree.h"
#include "schema/video_store.h"
#include "server/app/connection.h"
#include "server/app/reply_cache.h"
#include "server/app/video_files.h"

namespace haarmony::video {
class DecodedCache;
}

namespace haarmony::server {

struct VideoServiceOptions {
    std::string database_path;
    // Of decoded layers, of all clips together: those that were longest unused go first,
    // whichever clip's they are. Small clips are held whole, so that any frame of them is
    // only drawn.
    std::size_t layer_cache_bytes = std::size_t{512} << 20;
    std::size_t open_clips = 32;  // at the same time, each with the index of its file
    std::size_t reply_cache_bytes = std::size_t{64} << 20;  // of encoded pictures
    // Of the disk: what a build leaves to the database. A minute in full HD may need 40 GB
    // while it is built.
    std::uint64_t room_left = std::uint64_t{512} << 20;
};

// A video that is looked at.
class OpenVideo {
  public:
    virtual ~OpenVideo() = default;
    [[nodiscard]] const schema::Video& row() const { return row_; }
    [[nodiscard]] const video::TimeTree& clip() const { return *clip_; }

  protected:
    OpenVideo(schema::Video row, std::unique_ptr<video::TimeTree> clip)
        : row_(std::move(row)), clip_(std::move(clip)) {}

  private:
    schema::Video row_;
    std::unique_ptr<video::TimeTree> clip_;
};

class VideoService {
  public:
    // Deletes the files that belong to nobody.
    [[nodiscard]] static Result<std::unique_ptr<VideoService>> open(
        const VideoServiceOptions& options);

    [[nodiscard]] Result<schema::Video> get(std::int64_t id);
    [[nodiscard]] Result<std::vector<schema::Video>> list(int limit, std::int64_t after);
    [[nodiscard]] Result<std::int64_t> count();
    [[nodiscard]] Result<void> remove(std::int64_t id);

    // kNotFound where the video is gone, whoever has it open.
    [[nodiscard]] Result<std::shared_ptr<const OpenVideo>> clip(std::int64_t id);

    // The file `built` becomes a clip, with its row and the signatures of its frames. What
    // job `video.job` has added already is answered instead of being added again.
    // Requires: its content is on the disk.
    [[nodiscard]] Result<schema::Video> add(
        const std::string& built,
        const schema::Video& video,
        std::span<const schema::FrameSignature> frames);
    // The file `built` takes the place of the video's clip. What job `video.now.job` has done
    // already is answered instead of being done again. Requires: its content is on the disk.
    [[nodiscard]] Result<schema::Video> grow(
        const std::string& built,
        const schema::GrownVideo& video,
        std::span<const schema::FrameSignature> frames);
    [[nodiscard]] Result<std::optional<schema::Video>> made_by(std::int64_t job);

    [[nodiscard]] VideoFiles& files() { return files_; }
    [[nodiscard]] std::uint64_t room_left() const { return options_.room_left; }
    [[nodiscard]] ReplyCache& replies() { return replies_; }
    // Of decoded layers that are kept.
    [[nodiscard]] std::size_t layer_bytes() const;
    [[nodiscard]] ReadConnections& readers() { return readers_; }

  private:
    VideoService(const VideoServiceOptions& options, std::unique_ptr<Connection> writer);
    [[nodiscard]] Result<void> sweep();
    template <typename Work>
    auto read(Work&& work);

    struct Held {
        std::shared_ptr<const OpenVideo> video;
        std::uint64_t used = 0;  // the larger, the later
    };

    const VideoServiceOptions options_;
    VideoFiles files_;
    ReplyCache replies_;
    const std::shared_ptr<video::DecodedCache> layers_;  // of every clip

    std::mutex writer_mutex_;  // guards writer_
    std::unique_ptr<Connection> writer_;
    ReadConnections readers_;

    std::mutex mutex_;  // guards the two below
    std::map<std::int64_t, Held> held_;
    std::uint64_t uses_ = 0;
};

}  // namespace haarmony::server
