// The clients, against a server that says what a test wants.
#include "tests/bench/http/load.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "server/http/listener.h"
#include "tests/bench/http/posters.h"

namespace haarmony::bench {
namespace {

class LoadTest : public testing::Test {
  protected:
    LoadTest() {
        router_.add("GET", "/query", {}, [this](const http::Request& request) {
            const std::lock_guard lock(mutex_);
            ++asked_;
            remotes_.insert(request.remote);
            ids_.insert(std::stoll(request.query.at(0).second));
            return http::Response{.status = status_,
                                  .headers = {{"Server-Timing", "search;dur=0.25"}},
                                  .body = R"({"matches":[],"took_ms":0.5})"};
        });
        router_.add(
            "POST", "/query", {.body_limit = 100}, [this](const http::Request& request) {
                EXPECT_EQ(request.body, "picture");
                const int number = ++posted_;
                return http::Response{
                    .status = number % 3 == 0 ? 503 : 200, .headers = {}, .body = {}};
            });
        http::ListenerOptions options;
        options.port = 0;
        auto started = http::Listener::listen(options, router_, {});
        if (!started) throw std::runtime_error(started.error().message);
        listener_ = *std::move(started);
        load_.port = listener_->port();
        load_.largest_id = 5;
    }

    http::Router router_;
    std::mutex mutex_;
    int asked_ = 0;
    int status_ = 200;
    std::atomic<int> posted_ = 0;
    std::set<std::string> remotes_;
    std::set<std::int64_t> ids_;
    std::unique_ptr<http::Listener> listener_;
    LoadOptions load_;
};

TEST_F(LoadTest, AsksSoOftenOverSoManyConnections) {
    load_.connections = 3;
    load_.requests = 100;
    const auto waited = run_load(load_);
    ASSERT_EQ(waited.size(), 100U);
    EXPECT_EQ(asked_, 100);
    EXPECT_EQ(remotes_.size(), 3U);
    EXPECT_EQ(ids_, (std::set<std::int64_t>{1, 2, 3, 4, 5}));
    for (const Waited& one : waited) {
        EXPECT_GT(one.total, 0);
        EXPECT_EQ(one.took, 0.5);
        EXPECT_EQ(one.search, 0.25);
    }
}

TEST_F(LoadTest, AnyOtherAnswerEndsTheMeasurement) {
    status_ = 404;
    EXPECT_THROW((void)run_load(load_), std::runtime_error);
    listener_.reset();
    EXPECT_THROW((void)run_load(load_), std::runtime_error);
}

TEST_F(LoadTest, PostersPostUntilTheirEndAndCountTheAnswers) {
    const std::string picture = "picture";
    {
        Posters posters(load_.port, 2, picture);
        while (posted_ < 30) std::this_thread::yield();
        EXPECT_GT(posters.answered(), posters.refused());
        EXPECT_GT(posters.refused(), 0);
        EXPECT_EQ(posters.failed(), 0);
    }
    const int posted = posted_;
    EXPECT_GE(posted, 30);
    listener_.reset();
    Posters nobody_there(load_.port, 1, picture);
    while (nobody_there.failed() == 0) std::this_thread::yield();
    EXPECT_EQ(posted_, posted);
}

TEST(NumberAfter, IsReadOrRefusedByName) {
    EXPECT_EQ(number_after(R"({"a":1,"took_ms":2.5})", "\"took_ms\":"), 2.5);
    for (const char* text : {"", "{}", R"({"took_ms":"x"})"}) {
        try {
            (void)number_after(text, "\"took_ms\":");
            FAIL() << text;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("took_ms"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace haarmony::bench
