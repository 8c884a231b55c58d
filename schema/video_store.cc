#include "schema/video_store.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string_view>
#include <utility>

#include "schema/sqlite_error.h"
#include "schema/write_scope.h"

namespace haarmony::schema {
namespace {

constexpr std::string_view kAdd =
    "INSERT INTO videos (revision, name, width, height, frames, rate_numerator,"
    " rate_denominator, delta, time_nodes, complete_subtrees, pruned_subtrees,"
    " own_subtrees, uplinks, memory_bytes, disk_bytes, indexed, job_id, created_at)"
    " VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16,"
    " nullif(?17, 0), strftime('%Y-%m-%dT%H:%M:%fZ', 'now')) RETURNING id";

constexpr std::string_view kColumns =
    "SELECT id, revision, name, width, height, frames, rate_numerator, rate_denominator,"
    " delta, time_nodes, complete_subtrees, pruned_subtrees, own_subtrees, uplinks,"
    " memory_bytes, disk_bytes, indexed, job_id, created_at FROM videos";

constexpr std::string_view kAddFrame =
    "INSERT INTO frame_signatures (video_id, time_level, node, shot, signature)"
    " VALUES (?1, ?2, ?3, ?4, ?5)";

constexpr std::string_view kFramesAfter =
    "SELECT id, video_id, time_level, node, shot, signature FROM frame_signatures"
    " WHERE id > ?1 ORDER BY id LIMIT ?2";

constexpr std::string_view kGrow =
    "UPDATE videos SET revision = ?3, frames = ?4, time_nodes = ?5,"
    " complete_subtrees = ?6, pruned_subtrees = ?7, own_subtrees = ?8, uplinks = ?9,"
    " memory_bytes = ?10, disk_bytes = ?11, job_id = nullif(?12, 0)"
    " WHERE id = ?1 AND revision = ?2 RETURNING id";

// Frames on their way to new ids and time levels are kept apart from the old ones by time
// levels that no video has.
constexpr std::string_view kKeepFrames =
    "INSERT INTO frame_signatures (video_id, time_level, node, shot, signature)"
    " SELECT video_id, time_level + ?3 - ?2 + 1000, node, shot, signature"
    " FROM frame_signatures WHERE video_id = ?1 AND time_level > 0"
    " AND (((node >> 1) + 1) << (?2 - time_level + 1)) <= ?4 ORDER BY id";
constexpr std::string_view kDropFrames =
    "DELETE FROM frame_signatures WHERE video_id = ?1 AND time_level < 1000";
constexpr std::string_view kPlaceFrames =
    "UPDATE frame_signatures SET time_level = time_level - 1000"
    " WHERE video_id = ?1 AND time_level >= 1000";

std::string video_name(std::int64_t id) { return "video " + std::to_string(id); }

Error no_such_video(std::int64_t id) {
    return Error{ErrorCode::kNotFound, "no " + video_name(id), "video"};
}

Video video_of(const Statement& row) {
    Video video;
    video.id = row.integer(0);
    video.revision = row.text(1);
    video.name = row.text(2);
    video.width = row.integer(3);
    video.height = row.integer(4);
    video.frames = row.integer(5);
    video.rate_numerator = row.integer(6);
    video.rate_denominator = row.integer(7);
    video.delta = row.real(8);
    video.storage = {row.integer(9),
                     row.integer(10),
                     row.integer(11),
                     row.integer(12),
                     row.integer(13),
                     row.integer(14),
                     row.integer(15)};
    video.indexed = row.integer(16) != 0;
    if (!row.is_null(17)) video.job = row.integer(17);
    video.created_at = row.text(18);
    return video;
}

// The one video that `condition`, with its parameter, selects.
Result<std::optional<Video>> find(StatementCache& cache,
                                  std::string_view condition,
                                  std::int64_t value) {
    auto statement =
        cache.borrow(std::string(kColumns) + " WHERE " + std::string(condition));
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, value);
    const Result<bool> row = (*statement)->step();
    if (!row) return row.error();
    if (!*row) return std::optional<Video>();
    return std::optional<Video>(video_of(**statement));
}

Result<std::vector<Video>> read_page(StatementCache& cache,
                                     std::int64_t limit,
                                     std::int64_t after) {
    static const std::string sql =
        std::string(kColumns) + " WHERE id > ?1 ORDER BY id LIMIT ?2";
    auto statement = cache.borrow(sql);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, after);
    (*statement)->bind(2, limit);
    std::vector<Video> videos;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return row.error();
        if (!*row) return videos;
        videos.push_back(video_of(**statement));
    }
}

Result<std::int64_t> insert(StatementCache& cache, const Video& video) {
    auto statement = cache.borrow(kAdd);
    if (!statement) return std::move(statement).error();
    Statement& row = **statement;
    row.bind(1, video.revision);
    row.bind(2, video.name);
    row.bind(3, video.width);
    row.bind(4, video.height);
    row.bind(5, video.frames);
    row.bind(6, video.rate_numerator);
    row.bind(7, video.rate_denominator);
    row.bind_real(8, video.delta);
    row.bind(9, video.storage.time_nodes);
    row.bind(10, video.storage.complete_subtrees);
    row.bind(11, video.storage.pruned_subtrees);
    row.bind(12, video.storage.own_subtrees);
    row.bind(13, video.storage.uplinks);
    row.bind(14, video.storage.memory_bytes);
    row.bind(15, video.storage.disk_bytes);
    row.bind(16, std::int64_t{video.indexed});
    row.bind(17, video.job.value_or(0));
    const auto id = row.run_returning();
    if (!id) return id.error();
    return id->value();
}

Result<void> insert_frames(StatementCache& cache,
                           std::int64_t video,
                           std::span<const FrameSignature> frames) {
    auto statement = cache.borrow(kAddFrame);
    if (!statement) return std::move(statement).error();
    for (const FrameSignature& frame : frames) {
        (*statement)->reset();
        (*statement)->bind(1, video);
        (*statement)->bind(2, std::int64_t{frame.time_level});
        (*statement)->bind(3, frame.node);
        (*statement)->bind(4, frame.shot);
        (*statement)->bind(5, frame.signature);
        Result<void> stored = (*statement)->run();
        if (!stored)
            return while_doing("frame " + std::to_string(frame.node) + " of time level " +
                                   std::to_string(frame.time_level),
                               std::move(stored).error());
    }
    return {};
}

Result<void> update(StatementCache& cache, const GrownVideo& video) {
    auto statement = cache.borrow(kGrow);
    if (!statement) return std::move(statement).error();
    Statement& row = **statement;
    const Video& now = video.now;
    row.bind(1, video.before.id);
    row.bind(2, video.before.revision);
    row.bind(3, now.revision);
    row.bind(4, now.frames);
    row.bind(5, now.storage.time_nodes);
    row.bind(6, now.storage.complete_subtrees);
    row.bind(7, now.storage.pruned_subtrees);
    row.bind(8, now.storage.own_subtrees);
    row.bind(9, now.storage.uplinks);
    row.bind(10, now.storage.memory_bytes);
    row.bind(11, now.storage.disk_bytes);
    row.bind(12, now.job.value_or(0));
    const auto id = row.run_returning();
    if (!id) return id.error();
    if (!*id)
        return Error{
            ErrorCode::kNotFound,
            "no " + video_name(video.before.id) + " of revision " + video.before.revision,
            "video"};
    return {};
}

Result<void> keep_frames(StatementCache& cache, const GrownVideo& video) {
    auto statement = cache.borrow(kKeepFrames);
    if (!statement) return std::move(statement).error();
    (*statement)->bind(1, video.before.id);
    (*statement)->bind(2, std::int64_t{video.time_levels_before});
    (*statement)->bind(3, std::int64_t{video.time_levels});
    (*statement)->bind(4, video.before.frames);
    Result<void> done = (*statement)->run();
    if (done) done = cache.run(kDropFrames, video.before.id);
    if (done) done = cache.run(kPlaceFrames, video.before.id);
    return done;
}

}  // namespace

Result<Video> VideoStore::add(const Video& video,
                              std::span<const FrameSignature> frames,
                              const Step& before_commit) {
    const auto failed = [](Error error) {
        return while_doing("cannot store a video", std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    const Result<std::int64_t> id = insert(cache_, video);
    if (!id) return failed(id.error());
    Result<void> done = insert_frames(cache_, *id, frames);
    if (!done) return failed(std::move(done).error());
    auto stored = find(cache_, "id = ?1", *id);
    if (!stored) return failed(std::move(stored).error());
    done = before_commit(**stored);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return **std::move(stored);
}

Result<Video> VideoStore::get(std::int64_t id) {
    auto video = find(cache_, "id = ?1", id);
    if (!video) return while_doing("cannot read " + video_name(id), video.error());
    if (!*video) return no_such_video(id);
    return **std::move(video);
}

Result<std::optional<Video>> VideoStore::made_by(std::int64_t job) {
    auto video = find(cache_, "job_id = ?1", job);
    if (!video)
        return while_doing("cannot look for the video of job " + std::to_string(job),
                           video.error());
    return video;
}

Result<std::vector<Video>> VideoStore::list(int limit, std::int64_t after) {
    assert(limit >= 1);
    auto videos = read_page(cache_, limit, after);
    if (!videos) return while_doing("cannot list videos", videos.error());
    return videos;
}

Result<std::int64_t> VideoStore::count() {
    const auto failed = [](Error error) {
        return while_doing("cannot count videos", std::move(error));
    };
    auto statement = cache_.borrow("SELECT count(*) FROM videos");
    if (!statement) return failed(std::move(statement).error());
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return (*statement)->integer(0);
}

Result<Video> VideoStore::remove(std::int64_t id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot remove " + video_name(id), std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    auto video = find(cache_, "id = ?1", id);
    if (!video) return failed(std::move(video).error());
    if (!*video) return no_such_video(id);
    Result<void> done = cache_.run("DELETE FROM videos WHERE id = ?1", id);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return **std::move(video);
}

Result<Video> VideoStore::grow(const GrownVideo& video,
                               std::span<const FrameSignature> frames,
                               const Step& before_commit) {
    const std::int64_t id = video.before.id;
    const auto failed = [&](Error error) {
        return while_doing("cannot change " + video_name(id), std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    Result<void> done = update(cache_, video);
    if (done) done = keep_frames(cache_, video);
    if (done) done = insert_frames(cache_, id, frames);
    if (!done) return failed(std::move(done).error());
    auto stored = find(cache_, "id = ?1", id);
    if (!stored) return failed(std::move(stored).error());
    done = before_commit(**stored);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return **std::move(stored);
}

Result<void> VideoStore::while_nobody_writes(
    const std::function<Result<void>(const std::vector<Video>&)>& work) {
    const auto failed = [](Error error) {
        return while_doing("cannot look through the videos", std::move(error));
    };
    Result<WriteScope> scope = WriteScope::begin(cache_, WriteScope::Kind::kTransaction);
    if (!scope) return failed(std::move(scope).error());
    auto all = read_page(cache_, std::numeric_limits<std::int64_t>::max(), 0);
    if (!all) return failed(std::move(all).error());
    Result<void> done = work(*all);
    if (done) done = scope->commit();
    if (!done) return failed(std::move(done).error());
    return {};
}

Result<FramesVersion> VideoStore::frames_version() {
    const auto failed = [](Error error) {
        return while_doing("cannot count the frames", std::move(error));
    };
    auto statement =
        cache_.borrow("SELECT coalesce(max(id), 0), count(*) FROM frame_signatures");
    if (!statement) return failed(std::move(statement).error());
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return FramesVersion{(*statement)->integer(0), (*statement)->integer(1)};
}

Result<std::vector<FrameSignature>> VideoStore::frames_after(std::int64_t after,
                                                             int limit) {
    assert(limit >= 1);
    const auto failed = [](Error error) {
        return while_doing("cannot read the signatures of frames", std::move(error));
    };
    auto statement = cache_.borrow(kFramesAfter);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, after);
    (*statement)->bind(2, std::int64_t{limit});
    std::vector<FrameSignature> frames;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return frames;
        FrameSignature frame;
        frame.id = (*statement)->integer(0);
        frame.video = (*statement)->integer(1);
        frame.time_level = static_cast<int>((*statement)->integer(2));
        frame.node = (*statement)->integer(3);
        frame.shot = (*statement)->integer(4);
        const auto bytes = (*statement)->bytes(5);
        frame.signature.assign(bytes.begin(), bytes.end());
        frames.push_back(std::move(frame));
    }
}

Result<std::vector<std::int64_t>> VideoStore::frame_ids() {
    const auto failed = [](Error error) {
        return while_doing("cannot read the ids of frames", std::move(error));
    };
    // From the index of places, which is much smaller than the signatures.
    auto statement = cache_.borrow("SELECT id FROM frame_signatures");
    if (!statement) return failed(std::move(statement).error());
    std::vector<std::int64_t> ids;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) break;
        ids.push_back((*statement)->integer(0));
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

Result<bool> VideoStore::has_frame(std::int64_t id) {
    const auto failed = [&](Error error) {
        return while_doing("cannot look for frame " + std::to_string(id),
                           std::move(error));
    };
    auto statement = cache_.borrow("SELECT 1 FROM frame_signatures WHERE id = ?1");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, id);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return *row;
}

}  // namespace haarmony::schema
