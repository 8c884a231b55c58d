#include "server/app/snapshot_job.h"

#include <chrono>
#include <thread>

namespace haarmony::server {
namespace {

constexpr std::chrono::milliseconds kLoadingPoll{20};

Result<void> take_snapshot(JobContext& job,
                           const IndexFollower& follower,
                           SnapshotKeeper& keeper) {
    while (!follower.ready()) {
        if (job.cancelled()) return {};
        std::this_thread::sleep_for(kLoadingPoll);
    }
    const auto written = keeper.write([&](std::uint64_t bytes, std::uint64_t total) {
        job.counts().seen = static_cast<std::int64_t>(bytes);
        job.set_total(static_cast<std::int64_t>(total));
        job.progress();
        return !job.cancelled();
    });
    if (!written) {
        if (job.was_interrupted()) return {};
        return written.error();
    }
    job.counts().seen = written->bytes;
    job.set_total(written->bytes);
    job.note("bytes", written->bytes);
    job.note("images", written->images);
    job.note("sequence", written->sequence);
    return {};
}

}  // namespace

JobType snapshot_job(const IndexFollower& follower, SnapshotKeeper& keeper) {
    return {[&](JobContext& job) { return take_snapshot(job, follower, keeper); }};
}

}  // namespace haarmony::server
