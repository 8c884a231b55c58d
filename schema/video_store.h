// Videos in the database: what they are, and the signatures of their frames.
//
// What a video shows is in a file of its own, which this folder does not know. add() and
// remove() run a step of the caller's inside their transaction, so that row and file come
// and go together.
//
// Errors   kNotFound for an unknown id; kInvalidArgument for a value that the table refuses;
//          kUnavailable and kIo as in image_store.h; what the caller's step answers.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

// Counts of the dissertation's pixel-level tree, and bytes.
struct VideoStorage {
    std::int64_t time_nodes = 0;
    std::int64_t complete_subtrees = 0;
    std::int64_t pruned_subtrees = 0;
    std::int64_t own_subtrees = 0;
    std::int64_t uplinks = 0;
    std::int64_t memory_bytes = 0;
    std::int64_t disk_bytes = 0;

    friend bool operator==(const VideoStorage&, const VideoStorage&) = default;
};

struct Video {
    std::int64_t id = 0;   // >= 1, never used again
    std::string revision;  // of its content: 16 hexadecimal digits
    std::string name;      // at most 256 characters, may be empty
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t frames = 0;
    std::int64_t rate_numerator = 1;
    std::int64_t rate_denominator = 1;
    double delta = 0;  // in grey levels; 0: without loss
    VideoStorage storage;
    bool indexed = false;               // its frames have signatures
    std::optional<std::int64_t> job{};  // that made it
    std::string created_at;             // RFC 3339, UTC; given by the store
};

// A time node that a search can find.
struct FrameSignature {
    std::int64_t id = 0;  // given by the store, never used again
    std::int64_t video = 0;
    int time_level = 0;
    std::int64_t node = 0;
    std::int64_t shot = 0;  // of this video
    std::vector<std::uint8_t> signature;
};

// A video that frames were appended to. Of its old signatures those stay, and get new ids, of
// the halves of time nodes that were complete; nothing of them has changed but the time level.
struct GrownVideo {
    Video before;  // as it was read
    // With the new revision, frames, storage and job; all else is as before.
    Video now;
    int time_levels_before = 0;
    int time_levels = 0;
};

// Different whenever a frame was added or removed.
struct FramesVersion {
    std::int64_t last = 0;
    std::int64_t count = 0;

    friend bool operator==(const FramesVersion&, const FramesVersion&) = default;
};

class VideoStore {
  public:
    explicit VideoStore(Database& database) : cache_(database.handle()) {}

    using Step = std::function<Result<void>(const Video&)>;

    // Adds the row and its frames; `before_commit` hears the id and may still refuse.
    [[nodiscard]] Result<Video> add(const Video& video,
                                    std::span<const FrameSignature> frames,
                                    const Step& before_commit);
    [[nodiscard]] Result<Video> get(std::int64_t id);
    // The video that this job has made, if it came that far.
    [[nodiscard]] Result<std::optional<Video>> made_by(std::int64_t job);
    // Changes the row and adds the new frames' signatures; `before_commit` may still refuse.
    // kNotFound where the video is gone or has another revision by now.
    [[nodiscard]] Result<Video> grow(const GrownVideo& video,
                                     std::span<const FrameSignature> frames,
                                     const Step& before_commit);
    // In the order of ids, at most `limit` (>= 1), only ids above `after`.
    [[nodiscard]] Result<std::vector<Video>> list(int limit, std::int64_t after);
    [[nodiscard]] Result<std::int64_t> count();
    // What was removed.
    [[nodiscard]] Result<Video> remove(std::int64_t id);
    // Runs `work` with all videos while nobody adds or removes one, in any process.
    [[nodiscard]] Result<void> while_nobody_writes(
        const std::function<Result<void>(const std::vector<Video>&)>& work);

    [[nodiscard]] Result<FramesVersion> frames_version();
    // In the order of ids, at most `limit` (>= 1), only ids above `after`.
    [[nodiscard]] Result<std::vector<FrameSignature>> frames_after(std::int64_t after,
                                                                   int limit);
    // Of all frames, ascending.
    [[nodiscard]] Result<std::vector<std::int64_t>> frame_ids();
    [[nodiscard]] Result<bool> has_frame(std::int64_t id);

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
