#include "schema/job_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Jobs : public testing::Test {
  protected:
    [[nodiscard]] std::int64_t create() { return expect(store_.create("t", "{}")).id; }
    [[nodiscard]] std::int64_t create_running() {
        const auto id = create();
        expect(store_.start(id));
        return id;
    }
    [[nodiscard]] JobState state(std::int64_t id) { return expect(store_.get(id)).state; }
    [[nodiscard]] std::vector<std::int64_t> listed(int limit,
                                                   std::optional<std::int64_t> after) {
        std::vector<std::int64_t> ids;
        for (const Job& job : expect(store_.list(limit, after))) ids.push_back(job.id);
        return ids;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    JobStore store_{database_};
};

TEST_F(Jobs, GoFromQueuedOverRunningToDone) {
    const Job made = expect(store_.create("ingest", R"({"root":"/p"})"));
    EXPECT_EQ(made.type, "ingest");
    EXPECT_EQ(made.request, R"({"root":"/p"})");
    EXPECT_EQ(made.state, JobState::kQueued);
    EXPECT_EQ(made.counts, JobCounts{});
    EXPECT_EQ(made.total, -1);
    EXPECT_EQ(made.position, "");
    EXPECT_EQ(made.result, "{}");
    EXPECT_EQ(made.created_at.size(), std::string("2000-01-01T00:00:00.000Z").size());
    EXPECT_EQ(made.started_at + made.finished_at, "");

    expect(store_.start(made.id));
    EXPECT_EQ(state(made.id), JobState::kRunning);
    EXPECT_NE(expect(store_.get(made.id)).started_at, "");

    const JobCounts counts{9, 4, 3, 1, 1};
    const std::vector<std::string> errors = {"first \"bad\"", "second"};
    expect(store_.progress(made.id, counts, 100, "after:b", errors));
    Job now = expect(store_.get(made.id));
    EXPECT_EQ(now.counts, counts);
    EXPECT_EQ(now.total, 100);
    EXPECT_EQ(now.position, "after:b");
    EXPECT_EQ(now.errors, errors);
    EXPECT_EQ(now.finished_at, "");

    const std::vector<std::string> last = {"other"};
    expect(store_.finish(made.id, JobState::kDone, R"({"n":1})", last));
    now = expect(store_.get(made.id));
    EXPECT_EQ(now.state, JobState::kDone);
    EXPECT_EQ(now.counts, counts);
    EXPECT_EQ(now.result, R"({"n":1})");
    EXPECT_EQ(now.errors, last);
    EXPECT_NE(now.finished_at, "");
}

TEST_F(Jobs, TheOldestQueuedIsNextAndTheNewestIsListedFirst) {
    EXPECT_FALSE(expect(store_.next_queued()).has_value());
    const auto a = create();
    const auto b = create();
    const auto c = create();
    EXPECT_EQ(expect(store_.next_queued())->id, a);
    expect(store_.start(a));
    EXPECT_EQ(expect(store_.next_queued())->id, b);
    EXPECT_THAT(listed(10, std::nullopt), ElementsAre(c, b, a));
    EXPECT_THAT(listed(2, std::nullopt), ElementsAre(c, b));
    EXPECT_THAT(listed(2, b), ElementsAre(a));
    EXPECT_THAT(listed(2, a), IsEmpty());
    // Several errors are one job still.
    expect(store_.progress(a, {}, 0, "", std::vector<std::string>{"x", "y", "z"}));
    const auto jobs = expect(store_.list(1, b));
    ASSERT_EQ(jobs.size(), 1u);
    EXPECT_THAT(jobs[0].errors, ElementsAre("x", "y", "z"));
}

TEST_F(Jobs, OnlyTheFirstErrorsAreKept) {
    const auto id = create_running();
    std::vector<std::string> errors;
    for (std::size_t i = 0; i < kMaxJobErrors + 5; ++i) {
        errors.push_back("e" + std::to_string(i));
    }
    expect(store_.progress(id, {}, -1, "", errors));
    const auto kept = expect(store_.get(id)).errors;
    EXPECT_EQ(kept, std::vector(errors.begin(), errors.begin() + kMaxJobErrors));
    expect(store_.finish(id, JobState::kFailed, "{}", errors));
    EXPECT_EQ(expect(store_.get(id)).errors, kept);
    EXPECT_EQ(state(id), JobState::kFailed);
}

TEST_F(Jobs, CancellingAQueuedOneIsAtOnceAndARunningOneIsAsked) {
    const auto queued = create();
    const auto running = create_running();
    const Job cancelled = expect(store_.cancel(queued));
    EXPECT_EQ(cancelled.state, JobState::kCancelled);
    EXPECT_NE(cancelled.finished_at, "");
    EXPECT_FALSE(expect(store_.cancel_requested(queued)));

    EXPECT_FALSE(expect(store_.cancel_requested(running)));
    const Job asked = expect(store_.cancel(running));
    EXPECT_EQ(asked.state, JobState::kRunning);
    EXPECT_TRUE(asked.cancel_requested);
    EXPECT_TRUE(expect(store_.cancel_requested(running)));
    expect(store_.cancel(running));  // again changes nothing
    expect(store_.finish(running, JobState::kCancelled, "{}", {}));
    EXPECT_EQ(state(running), JobState::kCancelled);
    EXPECT_FALSE(expect(store_.cancel_requested(running)));
}

TEST_F(Jobs, ARestartQueuesWhatRanWithCountsErrorsAndPosition) {
    const auto first = create_running();
    const auto waiting = create();
    const auto asked = create_running();
    const auto done = create_running();
    const JobCounts counts{5, 5, 0, 0, 0};
    expect(store_.progress(first, counts, 50, "p5", std::vector<std::string>{"e"}));
    expect(store_.finish(done, JobState::kDone, "{}", {}));
    expect(store_.cancel(asked));

    Database again = open_database(folder_.file("x.db"));
    JobStore restarted(again);
    EXPECT_EQ(expect(restarted.requeue_running()), 1);
    const Job job = expect(restarted.next_queued()).value();
    EXPECT_EQ(job.id, first);
    EXPECT_EQ(job.counts, counts);
    EXPECT_EQ(job.total, 50);
    EXPECT_EQ(job.position, "p5");
    EXPECT_THAT(job.errors, ElementsAre("e"));
    EXPECT_EQ(state(waiting), JobState::kQueued);
    EXPECT_EQ(state(asked), JobState::kCancelled);
    EXPECT_EQ(state(done), JobState::kDone);
    EXPECT_EQ(expect(restarted.requeue_running()), 0);
    expect(restarted.start(first));
    EXPECT_EQ(expect(restarted.get(first)).counts, counts);
}

TEST_F(Jobs, UnknownIdsAreNamed) {
    const std::vector<Error> errors = {
        store_.get(7).error(),
        store_.start(7).error(),
        store_.progress(7, {}, 0, "", {}).error(),
        store_.finish(7, JobState::kDone, "{}", {}).error(),
        store_.cancel(7).error(),
        store_.cancel_requested(7).error(),
    };
    for (const Error& error : errors) {
        EXPECT_EQ(error.code, ErrorCode::kNotFound);
        EXPECT_NE(error.message.find("no job 7"), std::string::npos) << error.message;
    }
}

TEST_F(Jobs, BadValuesAreRefusedByNameAndLeaveNothing) {
    const auto id = create_running();
    const std::pair<Error, std::string> refused[] = {
        {store_.create("", "{}").error(), "type_is_a_word"},
        {store_.create(std::string(65, 't'), "{}").error(), "type_is_a_word"},
        {store_.create("t", "[]").error(), "request_is_a_json_object"},
        {store_.create("t", "{").error(), "request_is_a_json_object"},
        {store_.progress(id, {.seen = -1}, 0, "", {}).error(), "counts_are_not_negative"},
        {store_.progress(id, {.failed = -1}, 0, "", {}).error(),
         "counts_are_not_negative"},
        {store_.progress(id, {}, -2, "", {}).error(), "total_is_a_count_or_unknown"},
        {store_.finish(id, JobState::kDone, "1", std::vector<std::string>{"e"}).error(),
         "result_is_a_json_object"},
    };
    for (const auto& [error, constraint] : refused) {
        EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
        EXPECT_NE(error.message.find(constraint), std::string::npos) << error.message;
    }
    EXPECT_THAT(listed(10, std::nullopt), ElementsAre(id));
    EXPECT_EQ(state(id), JobState::kRunning);
    EXPECT_THAT(expect(store_.get(id)).errors, IsEmpty());
}

TEST_F(Jobs, ThoseThatFinishedFirstGoBeyondTheLimit) {
    const auto slow = create_running();
    // Finished jobs of long ago, one second after the other.
    run_sql(database_.handle(),
            "WITH RECURSIVE n (i) AS (VALUES (0) UNION ALL SELECT i + 1 FROM n"
            " WHERE i + 1 < " +
                std::to_string(kMaxFinishedJobs) +
                ") INSERT INTO jobs SELECT i + 100, 't', '{}', 'done', 0, 0, 0, 0, 0, 0,"
                " 0, '', '{}', '', 'x', strftime('%Y-%m-%dT%H:%M:%fZ', i, 'unixepoch')"
                " FROM n");
    run_sql(database_.handle(), "INSERT INTO job_errors VALUES (100, 0, 'gone with it')");
    const auto waiting = create();
    expect(store_.finish(slow, JobState::kDone, "{}", {}));
    EXPECT_EQ(store_.get(100).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(state(101), JobState::kDone);
    EXPECT_EQ(state(slow), JobState::kDone);
    EXPECT_EQ(sql_integer(database_.handle(), "SELECT count(*) FROM job_errors"), 0);
    expect(store_.cancel(waiting));
    EXPECT_EQ(store_.get(101).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(sql_integer(database_.handle(), "SELECT count(*) FROM jobs"),
              kMaxFinishedJobs);
}

// Every step from every state, against the arrows of job_store.h in plain code.
TEST_F(Jobs, RandomStepsGiveWhatTheRulesSay) {
    run_sql(database_.handle(), "PRAGMA synchronous = OFF");  // nothing crashes here
    struct Row {
        JobState state = JobState::kQueued;
        bool asked = false;
        std::int64_t seen = 0;
    };
    std::map<std::int64_t, Row> model;
    std::mt19937 random(5);
    const auto expect_step = [](const auto& result, bool allowed) {
        ASSERT_EQ(result.has_value(), allowed);
        if (!allowed) {
            EXPECT_EQ(result.error().code, ErrorCode::kConflict);
        }
    };
    for (int step = 0; step < 600; ++step) {
        if (model.empty() || random() % 8 == 0) model[create()];
        auto& [id, row] = *std::next(
            model.begin(), static_cast<std::ptrdiff_t>(random() % model.size()));
        const bool queued = row.state == JobState::kQueued;
        const bool running = row.state == JobState::kRunning;
        switch (random() % 6) {
            case 0:
                expect_step(store_.start(id), queued);
                if (queued) row.state = JobState::kRunning;
                break;
            case 1:
                expect_step(store_.progress(id, {.seen = step}, -1, "", {}), running);
                if (running) row.seen = step;
                break;
            case 2:
                expect_step(store_.finish(id, JobState::kFailed, "{}", {}), running);
                if (running) row = {JobState::kFailed, false, row.seen};
                break;
            case 3:
                expect_step(store_.cancel(id), queued || running);
                if (running) row.asked = true;
                if (queued) row.state = JobState::kCancelled;
                break;
            default:
                if (random() % 8 != 0) break;
                std::int64_t again = 0;
                for (auto& [other, ran] : model) {
                    if (ran.state != JobState::kRunning) continue;
                    ran.state = ran.asked ? JobState::kCancelled : JobState::kQueued;
                    again += ran.asked ? 0 : 1;
                    ran.asked = false;
                }
                EXPECT_EQ(expect(store_.requeue_running()), again);
        }
        for (const auto& [known, want] : model) {
            const Job job = expect(store_.get(known));
            ASSERT_EQ(word_of(job.state), word_of(want.state)) << known;
            ASSERT_EQ(job.cancel_requested, want.asked) << known;
            ASSERT_EQ(job.counts.seen, want.seen) << known;
        }
    }
}

TEST_F(Jobs, AWrongStateIsNamed) {
    const auto id = create();
    const auto refused = store_.progress(id, {}, 0, "", {});
    EXPECT_NE(refused.error().message.find("job 1 is queued, not running"),
              std::string::npos)
        << refused.error().message;
}

#ifndef NDEBUG
TEST_F(Jobs, FinishingAsRunningIsABug) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto id = create_running();
    EXPECT_DEATH(static_cast<void>(store_.finish(id, JobState::kRunning, "{}", {})),
                 "is_finished");
}
#endif

}  // namespace
}  // namespace haarmony::schema
