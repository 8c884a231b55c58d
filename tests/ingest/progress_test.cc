#include "ingest/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace haarmony::ingest {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// A Progress on a clock that stands still until it is moved.
class ProgressTest : public testing::Test {
  protected:
    Progress make(ProgressMode mode, int columns = 80) {
        return Progress(mode, columns, out_, err_, [this] { return now_; });
    }
    static Tally seen(std::int64_t count) {
        Tally tally;
        tally.seen = tally.added = count;
        return tally;
    }

    std::ostringstream out_;
    std::ostringstream err_;
    Progress::Clock::time_point now_{};
};

TEST_F(ProgressTest, DoneLineHasAllCountsAndTheTime) {
    Progress progress = make(ProgressMode::kNone);
    now_ += 12345ms;
    progress.done(
        {.seen = 9, .added = 1, .updated = 2, .skipped = 3, .failed = 4, .pruned = 5});
    EXPECT_EQ(
        out_.str(),
        "done: seen=9 added=1 updated=2 skipped=3 failed=4 pruned=5 seconds=12.345\n");
}

TEST_F(ProgressTest, NoneSaysNothingBeforeTheEnd) {
    Progress progress = make(ProgressMode::kNone);
    now_ += 1h;
    progress.progress(seen(10), 20);
    EXPECT_EQ(out_.str(), "");
}

TEST_F(ProgressTest, EachModeSpeaksOncePerInterval) {
    struct Mode {
        ProgressMode mode;
        std::chrono::milliseconds interval;
        int lines;  // in ten intervals: a bar and a reader of JSON hear of the start at once
    };
    for (const auto& [mode, interval, lines] :
         {Mode{ProgressMode::kBar, kBarInterval, 10},
          Mode{ProgressMode::kJson, kJsonInterval, 10},
          Mode{ProgressMode::kPlain, kPlainInterval, 9}}) {
        out_.str("");
        Progress progress = make(mode);
        int spoken = 0;
        std::size_t length = 0;
        for (std::chrono::milliseconds time = 0ms; time < 10 * interval; time += 10ms) {
            progress.progress(seen(time.count()), -1);
            spoken += out_.str().size() > length;
            length = out_.str().size();
            now_ += 10ms;
        }
        EXPECT_EQ(spoken, lines) << static_cast<int>(mode);
    }
}

TEST_F(ProgressTest, PlainLineTellsCountsRateAndTimeLeft) {
    Progress progress = make(ProgressMode::kPlain);
    now_ += kPlainInterval;
    progress.progress(seen(40), 100);
    EXPECT_EQ(
        out_.str(),
        "progress: seen=40 added=40 updated=0 skipped=0 failed=0 pruned=0 total=100 "
        "rate=20.0 eta_s=3\n");
}

TEST_F(ProgressTest, WhileTheTotalIsUnknownThereIsNoTimeLeft) {
    Progress progress = make(ProgressMode::kPlain);
    now_ += kPlainInterval;
    progress.progress(seen(40), -1);
    EXPECT_EQ(
        out_.str(),
        "progress: seen=40 added=40 updated=0 skipped=0 failed=0 pruned=0 rate=20.0\n");
}

TEST_F(ProgressTest, JsonIsOneObjectALineAndTheLastHasTheCounts) {
    Progress progress = make(ProgressMode::kJson);
    now_ += kJsonInterval;
    progress.progress(seen(10), -1);
    progress.failed("/a/\xff.png", "damaged: \"x\"");
    now_ += kJsonInterval;
    progress.progress(seen(20), 30);
    progress.done(
        {.seen = 9, .added = 1, .updated = 2, .skipped = 3, .failed = 4, .pruned = 5});
    std::vector<Json> objects;
    for (const std::string& line : lines_of(out_.str()))
        objects.push_back(Json::parse(line));
    ASSERT_EQ(objects.size(), 4u);
    EXPECT_EQ(objects[0]["event"], "progress");
    EXPECT_EQ(objects[0]["total"], nullptr);
    EXPECT_EQ(objects[0]["eta_s"], nullptr);
    EXPECT_EQ(objects[1],
              Json({{"event", "failed"},
                    {"path", "/a/\xef\xbf\xbd.png"},
                    {"reason", "damaged: \"x\""},
                    {"uri", "file:///a/%FF.png"}}));
    EXPECT_EQ(objects[2]["total"], 30);
    EXPECT_NEAR(objects[2]["rate"], 20.0, 1e-9);
    EXPECT_NEAR(objects[2]["eta_s"], 0.5, 1e-9);
    EXPECT_EQ(objects[3],
              Json({{"event", "done"},
                    {"seen", 9},
                    {"added", 1},
                    {"updated", 2},
                    {"skipped", 3},
                    {"failed", 4},
                    {"pruned", 5},
                    {"seconds", 1.0}}));
    EXPECT_THAT(lines_of(err_.str()), ElementsAre("failed: /a/\xff.png: damaged: \"x\""));
}

TEST_F(ProgressTest, AFailureIsOneLineWhateverTheNameIs) {
    Progress progress = make(ProgressMode::kPlain);
    progress.failed("/a\nb\x1b[2J\x7f.png", "line one\r\nline two");
    EXPECT_EQ(err_.str(),
              "failed: /a\\x0ab\\x1b[2J\\x7f.png: line one\\x0d\\x0aline two\n");
    EXPECT_THAT(out_.str(), IsEmpty());
}

TEST_F(ProgressTest, TheBarIsDrawnOverAndNeverWiderThanTheTerminal) {
    for (const int columns : {1, 10, 40, 200}) {
        out_.str("");
        Progress progress = make(ProgressMode::kBar, columns);
        now_ += kBarInterval;
        Tally tally = seen(5000);
        tally.failed = 12;
        progress.progress(tally, 10'000);
        const std::string text = out_.str();
        ASSERT_TRUE(text.starts_with("\r"));
        ASSERT_TRUE(text.ends_with("\x1b[K"));
        EXPECT_LT(text.size() - 4, static_cast<std::size_t>(std::max(columns, 2)));
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_THAT(out_.str(),
                HasSubstr("[############------------] 50% 5000/10000 files, "));
    EXPECT_THAT(out_.str(), HasSubstr(", 0:00 left, 12 failed"));
}

TEST_F(ProgressTest, TheBarMakesWayForFailuresAndForTheEnd) {
    Progress progress = make(ProgressMode::kBar);
    progress.failed("/a", "b");
    EXPECT_EQ(out_.str(), "");
    now_ += kBarInterval;
    progress.progress(seen(1), 2);
    progress.failed("/a", "b");
    EXPECT_TRUE(out_.str().ends_with("\x1b[K\r\x1b[K"));
    now_ += kBarInterval;
    progress.progress(seen(1), 2);
    progress.done({});
    EXPECT_THAT(out_.str(), HasSubstr("\x1b[K\r\x1b[Kdone: seen=0 "));
}

TEST_F(ProgressTest, TimeLeftIsWrittenAsAClock) {
    const std::pair<std::int64_t, const char*> cases[] = {
        {59, ", 0:59 left"}, {61, ", 1:01 left"}, {3661, ", 1:01:01 left"}};
    for (const auto& [seconds, text] : cases) {
        out_.str("");
        Progress progress = make(ProgressMode::kBar);
        now_ += 1s;
        progress.progress(seen(1), 1 + seconds);
        EXPECT_THAT(out_.str(), HasSubstr(text));
    }
}

TEST(Rate, OfSteadyWorkIsExactFromTheFirstUpdate) {
    const Rate::TimePoint start{};
    Rate rate(start);
    EXPECT_EQ(rate.seconds_for(5), std::nullopt);
    for (int i = 1; i <= 50; ++i) {
        rate.update(30 * i, start + 100ms * i);
        EXPECT_NEAR(rate.per_second(), 300.0, 1e-6);
    }
    EXPECT_NEAR(*rate.seconds_for(600), 2.0, 1e-6);
}

TEST(Rate, ForgetsTheFastBeginning) {
    const Rate::TimePoint start{};
    Rate rate(start);
    rate.update(100'000, start + 1s);
    rate.update(100'000 + 40 * 10, start + 41s);
    // The start weighs e^-8 of the whole after eight times the memory.
    EXPECT_NEAR(rate.per_second(), 10.0, 100'000 * std::exp(-8.0));
}

TEST(Rate, StandstillHasNoTimeLeft) {
    Rate rate(Rate::TimePoint{});
    rate.update(0, Rate::TimePoint{} + 1s);
    EXPECT_EQ(rate.seconds_for(1), std::nullopt);
    rate.update(0, Rate::TimePoint{} + 1s);
    EXPECT_EQ(rate.per_second(), 0);
}

}  // namespace
}  // namespace haarmony::ingest
