#include "server/app/job_runner.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using schema::JobCounts;
using schema::JobState;

class JobRunnerTest : public testing::Test {
  protected:
    std::unique_ptr<JobRunner> runner(JobTypes types) {
        JobRunnerOptions options;
        options.database_path = collection_.path();
        options.progress_interval = std::chrono::milliseconds(0);
        options.retry_interval = std::chrono::milliseconds(1);
        auto started = JobRunner::start(options, std::move(types));
        EXPECT_TRUE(started) << started.error().message;
        return std::move(started).value();
    }
    [[nodiscard]] schema::Job stored(std::int64_t id) {
        return beside(collection_)->jobs().get(id).value();
    }

    Collection collection_;
};

// Counts the lines of the log that hold `text`, while it lives.
class LogCount final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    explicit LogCount(std::string text) : text_(std::move(text)) {}
    [[nodiscard]] int count() const { return count_; }

  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (std::string(message.payload.data(), message.payload.size()).find(text_) !=
            std::string::npos)
            ++count_;
    }
    void flush_() override {}

  private:
    const std::string text_;
    std::atomic<int> count_{0};
};

TEST_F(JobRunnerTest, JobsRunOneAfterTheOtherInTheOrderOfTheirCreation) {
    std::vector<std::int64_t> order;
    std::atomic<int> running{0};
    std::atomic<int> most{0};
    const auto jobs = runner({{"note", {[&](JobContext& job) -> Result<void> {
                                   most = std::max(most.load(), ++running);
                                   order.push_back(job.job().id);
                                   --running;
                                   return {};
                               }}}});
    std::vector<std::int64_t> ids;
    for (int i = 0; i < 6; ++i) ids.push_back(jobs->create("note", "{}")->id);
    for (const std::int64_t id : ids)
        EXPECT_EQ(finished(*jobs, id).state, JobState::kDone);
    jobs->stop();
    EXPECT_EQ(order, ids);
    EXPECT_EQ(most, 1);
}

// What a job starts inherits it.
TEST_F(JobRunnerTest, JobsGiveWayToEverythingElse) {
    const int ours = ::getpriority(PRIO_PROCESS, 0);
    std::atomic<int> theirs{0};
    std::atomic<int> childs{0};
    const auto jobs =
        runner({{"note", {[&](JobContext&) -> Result<void> {
                     theirs = ::getpriority(PRIO_PROCESS, 0);
                     std::thread([&] { childs = ::getpriority(PRIO_PROCESS, 0); }).join();
                     return {};
                 }}}});
    const std::int64_t id = jobs->create("note", "{}")->id;
    EXPECT_EQ(finished(*jobs, id).state, JobState::kDone);
    EXPECT_EQ(theirs, std::min(ours + 10, 19));
    EXPECT_EQ(childs, theirs);
}

TEST_F(JobRunnerTest, KeepsCountsTotalTheFirstErrorsAndTheResult) {
    const auto jobs = runner({{"count", {[](JobContext& job) -> Result<void> {
                                   EXPECT_EQ(job.request(), R"({"a":1})");
                                   job.set_total(40);
                                   job.counts() = {40, 1, 2, 3, 0};
                                   for (int i = 0; i < 25; ++i)
                                       job.fail("error " + std::to_string(i));
                                   job.note("pairs", 7);
                                   return {};
                               }}}});
    const schema::Job job = done(*jobs, "count", R"({"a":1})");
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts, (JobCounts{40, 1, 2, 3, 25}));
    EXPECT_EQ(job.total, 40);
    ASSERT_EQ(job.errors.size(), schema::kMaxJobErrors);
    EXPECT_EQ(job.errors.front(), "error 0");
    EXPECT_EQ(job.errors.back(), "error 19");
    const auto result = nlohmann::json::parse(job.result);
    EXPECT_EQ(result["pairs"], 7);
    EXPECT_GT(result["rate"], 0.0);
    EXPECT_EQ(jobs->last_done("count").value(), job.finished_at);
    EXPECT_EQ(jobs->last_done("other").value(), std::nullopt);
}

TEST_F(JobRunnerTest, WhatEndedAFailedJobIsAmongItsErrors) {
    const auto jobs =
        runner({{"many", {[](JobContext& job) -> Result<void> {
                     for (int i = 0; i < 25; ++i) job.fail("small");
                     return Error{ErrorCode::kNotFound, "no profile 'x'"};
                 }}},
                {"io", {[](JobContext&) -> Result<void> {
                     return Error{ErrorCode::kIo, "/secret/file.db is locked"};
                 }}}});
    const schema::Job many = done(*jobs, "many", "{}");
    EXPECT_EQ(many.state, JobState::kFailed);
    EXPECT_EQ(many.errors.size(), schema::kMaxJobErrors);
    EXPECT_EQ(many.errors.back(), "no profile 'x'");
    const schema::Job io = done(*jobs, "io", "{}");
    EXPECT_EQ(io.state, JobState::kFailed);
    ASSERT_EQ(io.errors.size(), 1);
    EXPECT_EQ(io.errors[0].find("secret"), std::string::npos);
    EXPECT_EQ(jobs->last_done("many").value(), std::nullopt);
}

TEST_F(JobRunnerTest, AQueuedJobIsCancelledAtOnceAndNeverRuns) {
    Gate gate;
    std::atomic<int> ran{0};
    const auto jobs = runner({{"wait", {[&](JobContext& job) -> Result<void> {
                                   ++ran;
                                   gate.pass(job);
                                   return {};
                               }}}});
    const std::int64_t first = jobs->create("wait", "{}")->id;
    ASSERT_TRUE(gate.entered());
    const std::int64_t second = jobs->create("wait", "{}")->id;
    EXPECT_EQ(jobs->cancel(second)->state, JobState::kCancelled);
    gate.open();
    EXPECT_EQ(finished(*jobs, first).state, JobState::kDone);
    EXPECT_EQ(done(*jobs, "wait", "{}").state, JobState::kDone);
    EXPECT_EQ(stored(second).state, JobState::kCancelled);
    EXPECT_EQ(ran, 2);
}

TEST_F(JobRunnerTest, ARunningJobThatIsCancelledEndsAsCancelledAndTheNextOneRuns) {
    Gate gate;
    const auto jobs = runner({{"wait", {[&](JobContext& job) -> Result<void> {
                                   job.counts().seen = 3;
                                   gate.pass(job);
                                   return {};
                               }}}});
    const std::int64_t id = jobs->create("wait", "{}")->id;
    ASSERT_TRUE(gate.entered());
    EXPECT_TRUE(jobs->cancel(id)->cancel_requested);
    const schema::Job job = finished(*jobs, id);
    EXPECT_EQ(job.state, JobState::kCancelled);
    EXPECT_EQ(job.counts.seen, 3);
    gate.open();
    EXPECT_EQ(done(*jobs, "wait", "{}").state, JobState::kDone);
    const auto again = jobs->cancel(id);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::kConflict);
    EXPECT_EQ(jobs->cancel(77).error().code, ErrorCode::kNotFound);
}

TEST_F(JobRunnerTest, WhatWasDoneBeforeItHeardOfTheCancellationIsDone) {
    Gate gate;
    const auto jobs = runner({{"deaf", {[&](JobContext&) -> Result<void> {
                                   gate.pass();
                                   return {};
                               }}}});
    const std::int64_t id = jobs->create("deaf", "{}")->id;
    ASSERT_TRUE(gate.entered());
    ASSERT_TRUE(jobs->cancel(id));
    gate.open();
    EXPECT_EQ(finished(*jobs, id).state, JobState::kDone);
}

// Ten steps, one position each; waits at the gate before the sixth.
JobType ten_steps(Gate& gate, std::vector<std::string>& starts, bool resumes) {
    return {[&gate, &starts](JobContext& job) -> Result<void> {
                starts.push_back(job.position());
                for (int step = job.position().empty() ? 0 : std::stoi(job.position());
                     step < 10;
                     ++step) {
                    if (step == 5) gate.pass(job);
                    if (job.cancelled()) return {};
                    ++job.counts().seen;
                    job.fail("step " + std::to_string(step));
                    job.set_position(std::to_string(step + 1));
                    job.progress();
                }
                return {};
            },
            resumes};
}

TEST_F(JobRunnerTest, AJobThatRanWhenTheDaemonStoppedGoesOnAtItsPosition) {
    Gate gate;
    std::vector<std::string> starts;
    auto jobs = runner({{"steps", ten_steps(gate, starts, true)}});
    const std::int64_t id = jobs->create("steps", "{}")->id;
    ASSERT_TRUE(gate.entered());
    jobs->stop();
    EXPECT_EQ(stored(id).state, JobState::kRunning);
    EXPECT_EQ(stored(id).position, "5");
    EXPECT_EQ(stored(id).counts.seen, 5);
    gate.open();
    jobs = runner({{"steps", ten_steps(gate, starts, true)}});
    const schema::Job job = finished(*jobs, id);
    EXPECT_EQ(job.state, JobState::kDone);
    EXPECT_EQ(job.counts.seen, 10);
    EXPECT_EQ(job.errors.size(), 10);
    jobs->stop();
    EXPECT_EQ(starts, (std::vector<std::string>{"", "5"}));
}

TEST_F(JobRunnerTest, ATypeThatBeginsAnewCountsAnew) {
    Gate gate;
    std::vector<std::string> starts;
    auto jobs = runner({{"steps", ten_steps(gate, starts, false)}});
    const std::int64_t id = jobs->create("steps", "{}")->id;
    ASSERT_TRUE(gate.entered());
    jobs->stop();
    gate.open();
    jobs = runner({{"steps", ten_steps(gate, starts, false)}});
    const schema::Job job = finished(*jobs, id);
    EXPECT_EQ(job.counts.seen, 5);  // the steps after the position, which it may read
    EXPECT_EQ(job.errors.front(), "step 5");
}

TEST_F(JobRunnerTest, WhatWasCancelledWhenTheDaemonDiedIsNotTakenUpAgain) {
    const auto other = beside(collection_);
    const std::int64_t id = other->jobs().create("steps", "{}")->id;
    ASSERT_TRUE(other->jobs().start(id));
    ASSERT_TRUE(other->jobs().cancel(id));
    const auto jobs = runner({});
    EXPECT_EQ(jobs->get(id)->state, JobState::kCancelled);
}

TEST_F(JobRunnerTest, UnknownTypesAreRefusedAndThoseOfAnotherVersionFail) {
    const std::int64_t id = beside(collection_)->jobs().create("paint", "{}")->id;
    const auto jobs = runner({});
    const schema::Job job = finished(*jobs, id);
    EXPECT_EQ(job.state, JobState::kFailed);
    EXPECT_EQ(job.errors, std::vector<std::string>{"there is no job type 'paint'"});
    const auto refused = jobs->create("paint", "{}");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(refused.error().param, "type");
}

TEST_F(JobRunnerTest, OnlyARunningJobHasAPace) {
    Gate gate;
    const auto jobs = runner({{"wait", {[&](JobContext& job) -> Result<void> {
                                   job.set_total(10);
                                   job.counts().seen = 4;
                                   job.progress();
                                   gate.pass(job);
                                   return {};
                               }}}});
    const std::int64_t id = jobs->create("wait", "{}")->id;
    ASSERT_TRUE(gate.entered());
    schema::Job job = jobs->get(id).value();
    const auto pace = jobs->pace(job);
    ASSERT_TRUE(pace);
    EXPECT_GT(pace->rate, 0);
    ASSERT_TRUE(pace->eta_s);
    EXPECT_DOUBLE_EQ(*pace->eta_s * pace->rate, 6);
    job.total = -1;
    EXPECT_FALSE(jobs->pace(job)->eta_s);
    gate.open();
    EXPECT_FALSE(jobs->pace(finished(*jobs, id)));
}

TEST_F(JobRunnerTest, ADatabaseThatFailsIsTriedAgain) {
    const auto log = std::make_shared<LogCount>("event=jobs_failed");
    spdlog::default_logger()->sinks().push_back(log);
    const auto sql = [&](const std::string& statement) {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(), statement);
    };
    const auto jobs = runner({{"break", {[&](JobContext&) -> Result<void> {
                                   sql("ALTER TABLE jobs RENAME TO elsewhere");
                                   return {};
                               }}}});
    const std::int64_t id = jobs->create("break", "{}")->id;
    EXPECT_TRUE(becomes_true([&] { return log->count() > 0; }));
    EXPECT_FALSE(jobs->get(id));
    sql("ALTER TABLE elsewhere RENAME TO jobs");
    EXPECT_EQ(finished(*jobs, id).state, JobState::kDone);
    spdlog::default_logger()->sinks().pop_back();
}

TEST_F(JobRunnerTest, ProgressIsWrittenNowAndThenAndWhollyWhenItIsAskedFor) {
    const auto connection = beside(collection_);
    const std::int64_t id = connection->jobs().create("any", "{}")->id;
    ASSERT_TRUE(connection->jobs().start(id));
    const std::atomic<bool> stop{false};
    JobContext job(*connection, stored(id), stop, std::chrono::hours(1));
    for (int i = 0; i < 100; ++i) {
        ++job.counts().seen;
        job.progress();
    }
    EXPECT_EQ(stored(id).counts.seen, 1);
    ASSERT_TRUE(job.write());
    EXPECT_EQ(stored(id).counts.seen, 100);
}

TEST_F(JobRunnerTest, AProgressThatCannotBeWrittenIsLoggedAndTheJobGoesOn) {
    const auto log = std::make_shared<LogCount>("event=job_progress_not_written");
    spdlog::default_logger()->sinks().push_back(log);
    const auto connection = beside(collection_);
    const std::int64_t id = connection->jobs().create("any", "{}")->id;
    const std::atomic<bool> stop{false};
    JobContext job(*connection, stored(id), stop, std::chrono::milliseconds(0));
    job.progress();  // it is queued, so that the table refuses it
    EXPECT_EQ(log->count(), 1);
    EXPECT_FALSE(job.cancelled());
    spdlog::default_logger()->sinks().pop_back();
}

TEST_F(JobRunnerTest, AFileThatIsNoDatabaseIsRefused) {
    schema::write_bytes(collection_.folder.file("text.db"), "this is no database at all");
    JobRunnerOptions options;
    options.database_path = collection_.folder.file("text.db");
    const auto refused = JobRunner::start(options, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNotADatabase);
}

// What a job was sent is thrown away then, and neither sooner nor never.
TEST_F(JobRunnerTest, TheTypeHearsOfEveryEndAfterTheRowSaysSo) {
    std::mutex mutex;
    std::map<std::int64_t, JobState> ends;
    Gate gate;
    JobType type;
    type.run = [&](JobContext& job) -> Result<void> {
        if (job.request() == R"({"fail":1})")
            return Error{ErrorCode::kInvalidArgument, "it had to"};
        if (job.request() == R"({"wait":1})") gate.pass(job);
        return {};
    };
    type.ended = [&](const schema::Job& job) {
        const JobState state = stored(job.id).state;
        const std::lock_guard lock(mutex);
        ends[job.id] = state;
    };
    const auto jobs = runner({{"note", type}});
    const auto end_of = [&](std::int64_t id) {
        JobState state = JobState::kQueued;
        EXPECT_TRUE(becomes_true([&] {
            const std::lock_guard lock(mutex);
            if (ends.contains(id)) state = ends[id];
            return ends.contains(id);
        }));
        return state;
    };
    const auto id_of = [&](const std::string& request) {
        return jobs->create("note", request)->id;
    };
    EXPECT_EQ(end_of(id_of("{}")), JobState::kDone);
    EXPECT_EQ(end_of(id_of(R"({"fail":1})")), JobState::kFailed);
    const auto running = id_of(R"({"wait":1})");
    ASSERT_TRUE(gate.entered());
    const auto queued = id_of("{}");
    ASSERT_TRUE(jobs->cancel(queued));
    EXPECT_EQ(end_of(queued), JobState::kCancelled);
    ASSERT_TRUE(jobs->cancel(running));
    EXPECT_EQ(end_of(running), JobState::kCancelled);
    // A job that goes on at the next start has not ended.
    const auto interrupted = id_of(R"({"wait":1})");
    EXPECT_TRUE(
        becomes_true([&] { return stored(interrupted).state == JobState::kRunning; }));
    jobs->stop();
    EXPECT_FALSE(ends.contains(interrupted));
}

}  // namespace
}  // namespace haarmony::server
