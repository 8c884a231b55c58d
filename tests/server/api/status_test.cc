// /healthz, /readyz, /status, /version.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "ingest/sniff.h"
#include "schema/database.h"
#include "server/api/routes.h"
#include "server/api/status.h"
#include "server/version.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

TEST(Status, HealthAndReadinessAnswer) {
    Interface interface;
    EXPECT_EQ(json_of(interface.get("/healthz")), (json{{"status", "ok"}}));
    EXPECT_EQ(json_of(interface.get("/readyz")), (json{{"status", "ready"}}));
    EXPECT_EQ(interface.send("HEAD", "/healthz").status, 200);
    EXPECT_EQ(header_of(interface.get("/readyz"), "Cache-Control"), "no-store");
}

// A handler that waits for anything would hold up every connection.
TEST(Status, HealthAndReadinessAloneAreInstant) {
    for (const Route& route : routes())
        EXPECT_EQ(route.cost == http::Cost::kInstant,
                  route.pattern == "/healthz" || route.pattern == "/readyz")
            << route.pattern;
}

TEST(Status, RequestsThatMayWaitForAWriterAreCostly) {
    for (const Route& route : routes()) {
        if (route.method == "GET") continue;
        EXPECT_EQ(route.cost, http::Cost::kCostly)
            << route.method << " " << route.pattern;
    }
}

TEST(Status, UntilTheCollectionIsLoadedTheDaemonIsWellButNotReady) {
    Collection collection;
    const auto sql = [&](const std::string& statement) {
        const schema::RawConnection raw(collection.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(), statement);
    };
    sql("ALTER TABLE changes RENAME TO elsewhere");
    ImageServiceOptions options;
    options.database_path = collection.path();
    auto service = ImageService::open(options);
    ASSERT_TRUE(service);
    const auto jobs = JobRunner::start({collection.path()}, {});
    ASSERT_TRUE(jobs);
    const auto duplicates = DuplicateGroups::open(collection.path());
    ASSERT_TRUE(duplicates);
    const auto curves = CurveService::open(collection.path());
    ASSERT_TRUE(curves);
    VideoServiceOptions showing;
    showing.database_path = collection.path();
    const auto videos = VideoService::open(showing);
    ASSERT_TRUE(videos);
    FrameSearch frames(collection.path(), service.value()->index().index_m());
    ClusterOverview clusters(collection.path(), service.value()->index(), 0);
    const Context context{*service.value(),
                          *jobs.value(),
                          *duplicates.value(),
                          clusters,
                          *curves.value(),
                          *videos.value(),
                          frames,
                          MediaRoots::open({}).value()};
    http::Router router;
    add_routes(context, router);
    const auto get = [&](const std::string& path) {
        http::Request request;
        request.method = "GET";
        request.path = path;
        if (path == "/query") request.query = {{"id", "1"}};
        return router.dispatch(request);
    };
    EXPECT_EQ(get("/healthz").status, 200);
    for (const char* path : {"/readyz", "/query", "/images/1/similar"}) {
        const http::Response response = get(path);
        EXPECT_EQ(refusal_of(response), (Refusal{503, "unavailable", ""})) << path;
        EXPECT_EQ(header_of(response, "Retry-After"), "1");
    }
    EXPECT_EQ(json_of(get("/status"))["ready"], 0);
    sql("ALTER TABLE elsewhere RENAME TO changes");
    EXPECT_TRUE(becomes_true([&] { return get("/readyz").status == 200; }));
}

TEST(Status, CountsAreFlatNumbersAndTrue) {
    Interface interface;
    const json before = json_of(interface.get("/status"));
    EXPECT_EQ(before["images"], 0);
    EXPECT_EQ(before["bytes_per_image"], 0.0);
    for (unsigned number = 1; number <= 5; ++number) interface.collection.add(number);
    interface.send("DELETE", "/images/2");
    const json status = json_of(interface.get("/status"));
    for (const auto& [name, value] : status.items())
        EXPECT_TRUE(value.is_number()) << name;
    EXPECT_EQ(status["images"], 4);
    EXPECT_EQ(status["searchable"], 4);
    EXPECT_EQ(status["frames"], 0);
    EXPECT_EQ(status["failed"], 0);
    EXPECT_EQ(status["damaged_signatures"], 0);
    EXPECT_EQ(status["index_m"], 60);
    EXPECT_EQ(status["ready"], 1);
    EXPECT_EQ(status["snapshot_sequence"], 0);
    EXPECT_EQ(status["began_with_snapshot"], 0);
    EXPECT_EQ(status["bytes_per_image"].get<double>(),
              status["index_bytes"].get<double>() / 4);
}

TEST(Status, TheVersionTellsWhatCanBeRead) {
    Interface interface;
    const json version = json_of(interface.get("/version"));
    EXPECT_EQ(version["version"], std::string(kVersion));
    EXPECT_EQ(version["schema"], schema::current_version());
    std::set<std::string> types;
    for (const json& format : version["formats"]) types.insert(format["media_type"]);
    for (const char* type : {"image/jpeg", "image/png", "image/gif", "image/webp"})
        EXPECT_TRUE(types.contains(type)) << type;
    EXPECT_EQ(version["formats"].size(), ingest::formats().size());
}

TEST(Status, ParametersAreRefusedByName) {
    Interface interface;
    for (const std::string path : {"/healthz", "/readyz", "/status", "/version"})
        EXPECT_EQ(refusal_of(interface.get(path + "?verbose=1")),
                  (Refusal{400, "unknown_parameter", "verbose"}))
            << path;
}

TEST(Status, ADatabaseThatFailsIsA500WithoutDetails) {
    Interface interface;
    const schema::RawConnection raw(interface.collection.path());
    schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
    schema::run_sql(raw.handle(), "ALTER TABLE images RENAME TO elsewhere");
    const http::Response response = interface.get("/status");
    EXPECT_EQ(refusal_of(response), (Refusal{500, "internal", ""}));
    EXPECT_EQ(body_of(response).find("table"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::server
