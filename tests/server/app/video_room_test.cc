// A disk that has no room for a video.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "server/app/job_runner.h"
#include "server/app/video_job.h"
#include "server/app/video_request.h"
#include "server/app/video_service.h"
#include "tests/schema/scratch_folder.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

schema::Job built_with(const std::string& database, std::uint64_t room_left) {
    VideoServiceOptions options;
    options.database_path = database;
    options.room_left = room_left;
    const auto videos = VideoService::open(options);
    EXPECT_TRUE(videos) << videos.error().message;
    JobRunnerOptions running;
    running.database_path = database;
    running.progress_interval = std::chrono::milliseconds(0);
    const auto runner = JobRunner::start(
        running, {{"video", video_job(**videos, *MediaRoots::open({}))}});
    EXPECT_TRUE(runner) << runner.error().message;
    VideoRequest request;
    request.origin = VideoOrigin::kGenerated;
    request.generator = "julia";
    request.parameters.width = 16;
    request.parameters.height = 16;
    request.parameters.frames = 3;
    return done(**runner, "video", to_text(request));
}

TEST(VideoRoom, ABuildEndsBeforeTheDiskIsFullAndLeavesNothing) {
    const schema::ScratchFolder folder;
    const std::string database = folder.file("x.db");
    const schema::Job refused =
        built_with(database, std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(refused.state, schema::JobState::kFailed);
    ASSERT_EQ(refused.errors.size(), 1u);
    EXPECT_TRUE(refused.errors[0].starts_with("the disk has ")) << refused.errors[0];
    EXPECT_NE(refused.errors[0].find(" MB left after frame 1"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_empty(database + ".videos"));
    EXPECT_EQ(built_with(database, 0).state, schema::JobState::kDone);
}

TEST(VideoRoom, AFolderThatIsGoneIsAnError) {
    const schema::ScratchFolder folder;
    const VideoFiles files(folder.file("x.db"));
    EXPECT_EQ(files.free_bytes().error().code, ErrorCode::kNotFound);
    ASSERT_TRUE(files.prepare());
    EXPECT_GT(files.free_bytes().value(), 0u);
}

}  // namespace
}  // namespace haarmony::server
