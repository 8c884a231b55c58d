// schema/openapi.yaml says what is true: its routes are the router's, its parameters are
// read, and what the handlers answer is what it describes.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/curve/built_in_character.h"
#include "server/api/routes.h"
#include "server/embedded.h"
#include "server/version.h"
#include "tests/server/api/drawn_curves.h"
#include "tests/server/api/interface.h"
#include "tests/server/api/json_schema.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

const json& document() {
    static const json parsed = json::parse(embedded_openapi().front().content);
    return parsed;
}

// Follows one "$ref", if that is what the node is.
const json& resolved(const json& node) {
    if (!node.contains("$ref")) return node;
    return document().at(json::json_pointer(node["$ref"].get<std::string>().substr(1)));
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(c));
    return text;
}

// "GET /images" as the document has it, and the operation.
const json& operation(const Route& route) {
    return document()["paths"]
        .at(std::string(route.pattern))
        .at(lower(std::string(route.method)));
}

// The first violation of what the document says about this status of this route.
std::optional<std::string> violation_of(const std::string& method,
                                        const std::string& pattern,
                                        const http::Response& response) {
    const json& responses =
        document()["paths"].at(pattern).at(lower(method)).at("responses");
    const std::string status = std::to_string(response.status);
    if (!responses.contains(status)) return "status " + status + " is not described";
    const json& described = resolved(responses[status]);
    const std::string type = header_of(response, "Content-Type");
    if (!described.contains("content"))
        return body_of(response).empty()
                   ? std::nullopt
                   : std::optional<std::string>("a body is not described");
    const json& content = described["content"];
    if (!content.contains(type)) return "type " + type + " is not described";
    if (!content[type].contains("schema")) return {};
    return violation(json_of(response), content[type]["schema"], document());
}

TEST(Openapi, ListsExactlyTheRoutesOfTheRouter) {
    std::set<std::string> described;
    for (const auto& [path, item] : document()["paths"].items())
        for (const auto& [member, value] : item.items())
            if (member != "parameters") described.insert(member + " " + path);
    std::set<std::string> routed;
    for (const Route& route : routes())
        routed.insert(lower(std::string(route.method)) + " " +
                      std::string(route.pattern));
    EXPECT_EQ(described, routed);
}

TEST(Openapi, EveryReferenceLeadsSomewhereAndEveryComponentIsUsed) {
    std::set<std::string> used;
    const auto walk = [&](const auto& self, const json& node) -> void {
        if (node.is_object() && node.contains("$ref")) {
            const std::string reference = node["$ref"];
            EXPECT_TRUE(document().contains(json::json_pointer(reference.substr(1))))
                << reference;
            used.insert(reference);
        }
        if (node.is_structured())
            for (const json& child : node) self(self, child);
    };
    walk(walk, document());
    for (const char* kind :
         {"parameters", "requestBodies", "responses", "schemas", "headers"})
        for (const auto& [name, component] : document()["components"][kind].items())
            EXPECT_TRUE(used.contains("#/components/" + std::string(kind) + "/" + name))
                << kind << "/" << name;
}

TEST(Openapi, SaysWhichVersionItDescribes) {
    EXPECT_EQ(document()["openapi"], "3.1.0");
    EXPECT_EQ(document()["info"]["version"], std::string(kVersion));
}

TEST(Openapi, OpenRoutesNeedNoKey) {
    for (const Route& route : routes()) {
        const json security = operation(route).value("security", json());
        EXPECT_EQ(route.open, security == json::array({json::object()})) << route.pattern;
    }
}

TEST(Openapi, EveryDescribedParameterIsKnownToItsHandler) {
    Interface interface;
    interface.collection.add(1);
    for (const Route& route : routes()) {
        if (!operation(route).contains("parameters")) continue;
        for (const json& reference : operation(route)["parameters"]) {
            const json& parameter = resolved(reference);
            std::string target(route.pattern);
            if (const auto at = target.find("{id}"); at != std::string::npos)
                target.replace(at, 4, "1");
            const http::Response response = interface.send(
                std::string(route.method),
                target + "?" + parameter["name"].get<std::string>() + "=1");
            EXPECT_NE(refusal_of(response).code, "unknown_parameter")
                << route.method << " " << target << " " << parameter["name"];
        }
    }
}

TEST(Openapi, RepliesAreAsDescribed) {
    schema::ScratchFolder media;
    Interface interface({media.path()});
    const std::string bytes = text_of(jpeg_scene(1));
    const auto check = [&](const std::string& method,
                           const std::string& pattern,
                           int status,
                           const http::Response& response) {
        EXPECT_EQ(response.status, status)
            << method << " " << pattern << body_of(response);
        const auto found = violation_of(method, pattern, response);
        EXPECT_FALSE(found) << method << " " << pattern << ": " << *found << "\n"
                            << body_of(response);
    };
    check("POST", "/images", 201, interface.post("/images?tags=a", "image/jpeg", bytes));
    check("POST", "/images", 201, interface.post("/images?uri=x:y", "image/jpeg", bytes));
    check("POST", "/images", 400, interface.post("/images", "image/jpeg", ""));
    check("POST", "/images", 415, interface.post("/images", "text/plain", "x"));
    check("POST",
          "/images",
          422,
          interface.post("/images", "image/jpeg", bytes.substr(0, 99)));
    check("GET", "/images", 200, interface.get("/images?limit=1"));
    check("GET", "/images", 200, interface.get("/images"));
    check("GET", "/images", 400, interface.get("/images?limit=0"));
    check("GET", "/images/{id}", 200, interface.get("/images/1"));
    check("GET", "/images/{id}", 404, interface.get("/images/77"));
    check("GET", "/images/{id}", 400, interface.get("/images/x"));
    check("GET", "/images/{id}/signature", 200, interface.get("/images/1/signature"));
    check("GET", "/images/{id}/thumbnail", 200, interface.get("/images/1/thumbnail"));
    check("GET", "/images/{id}/original", 404, interface.get("/images/1/original"));
    check("GET", "/images/{id}/similar", 200, interface.get("/images/1/similar?seq=1"));
    check("GET", "/query", 200, interface.get("/query?id=1&seq=x"));
    check("GET", "/query", 400, interface.get("/query"));
    check("GET", "/query", 403, interface.get("/query?url=http://example.org"));
    check("GET", "/query", 404, interface.get("/query?id=77"));
    check("POST", "/query", 200, interface.post("/query", "image/jpeg", bytes));
    check("POST", "/query", 415, interface.post("/query", "image/jpeg", "text"));
    check("GET", "/healthz", 200, interface.get("/healthz"));
    check("GET", "/readyz", 200, interface.get("/readyz"));
    check("GET", "/status", 200, interface.get("/status"));
    check("GET", "/version", 200, interface.get("/version"));
    check("GET", "/openapi.json", 200, interface.get("/openapi.json"));
    check("DELETE", "/images/{id}", 204, interface.send("DELETE", "/images/1"));
    check("DELETE", "/images/{id}", 404, interface.send("DELETE", "/images/1"));

    const auto other = beside(interface.collection);
    ASSERT_TRUE(other->images().mark_failed("file:///bad.jpg", {}, "truncated"));
    check("GET", "/images/{id}", 200, interface.get("/images/3"));
}

TEST(Openapi, JobsAndTheCollectionAreAsDescribed) {
    Interface interface;
    for (const unsigned number : {1U, 1U, 2U}) interface.collection.add(number);
    const auto check = [](const std::string& method,
                          const std::string& pattern,
                          int status,
                          const http::Response& response) {
        EXPECT_EQ(response.status, status)
            << method << " " << pattern << body_of(response);
        EXPECT_EQ(violation_of(method, pattern, response), std::nullopt)
            << method << " " << pattern << "\n"
            << body_of(response);
    };
    const std::vector<json> jobs{{{"type", "find_duplicates"}, {"min_similarity", 0.5}},
                                 {{"type", "reindex"}, {"profile", "painted"}},
                                 {{"type", "reindex"},
                                  {"color_space", "lab"},
                                  {"decomposition", "standard"},
                                  {"all", true}}};
    for (const json& job : jobs) {
        EXPECT_EQ(
            violation(job, document()["components"]["schemas"]["JobRequest"], document()),
            std::nullopt)
            << job;
        check("POST", "/jobs", 202, interface.post_json("/jobs", job));
    }
    check("POST", "/jobs", 202, interface.post_json("/jobs", {{"type", "snapshot"}}));
    check("POST", "/jobs", 400, interface.post_json("/jobs", {{"type", "paint"}}));
    check("POST",
          "/jobs",
          403,
          interface.post_json("/jobs", {{"type", "ingest"}, {"paths", {"/"}}}));
    check("GET", "/jobs", 200, interface.get("/jobs?limit=1"));
    EXPECT_EQ(finished(*interface.jobs, 3).state, schema::JobState::kDone);
    check("GET", "/jobs/{id}", 200, interface.get("/jobs/1"));
    check("GET", "/jobs/{id}", 404, interface.get("/jobs/77"));
    check("GET", "/jobs/{id}/events", 200, interface.get("/jobs/1/events"));
    check("GET", "/jobs/{id}/events", 404, interface.get("/jobs/77/events"));
    check("DELETE", "/jobs/{id}", 409, interface.send("DELETE", "/jobs/1"));
    check("GET", "/duplicates", 200, interface.get("/duplicates"));
    check("GET", "/duplicates", 400, interface.get("/duplicates?level=x"));
    const json pair{{"ids", {1, 2}}};
    check("POST",
          "/duplicates/ignore",
          204,
          interface.post_json("/duplicates/ignore", pair));
    check("POST",
          "/duplicates/ignore",
          404,
          interface.post_json("/duplicates/ignore", {{"ids", {1, 77}}}));
    EXPECT_EQ(
        violation(pair, document()["components"]["schemas"]["IgnoreRequest"], document()),
        std::nullopt);
    check("GET", "/clusters", 200, interface.get("/clusters?count=2"));
    check("GET", "/clusters", 400, interface.get("/clusters?count=0"));
}

TEST(Openapi, CurvesAndSurfacesAreAsDescribed) {
    Interface interface;
    const auto check = [&](const std::string& method,
                           const std::string& pattern,
                           int status,
                           const json& body,
                           const std::string& name = "") {
        std::string target = pattern;
        if (const auto at = target.find("{name}"); at != std::string::npos)
            target.replace(at, 6, name);
        const http::Headers headers =
            body.is_null() ? http::Headers{}
                           : http::Headers{{"Content-Type", "application/json"}};
        const http::Response response = interface.send(
            method, target, headers, body.is_null() ? std::string() : body.dump());
        EXPECT_EQ(response.status, status)
            << method << " " << target << body_of(response);
        EXPECT_EQ(violation_of(method, pattern, response), std::nullopt)
            << method << " " << target << "\n"
            << body_of(response);
        if (body.is_null() || status >= 300) return json_of(response);
        const json& described = document()["paths"][pattern][lower(method)]["requestBody"]
                                          ["content"]["application/json"]["schema"];
        EXPECT_EQ(violation(body, described, document()), std::nullopt) << body;
        return json_of(response);
    };
    const json points = random_points(11, 2, 1);
    const json curve{{"points", points}};
    const json stroke{{"samples", random_points(30, 2, 2)}, {"corners", {0.5}}};
    const json path{{"d", "M0 0L9 9L18 0z"}, {"subpath", 0}, {"fit_tolerance", 1}};
    for (const json& source : {curve, stroke, path}) {
        json apart = check("POST", "/curve/decompose", 200, source);
        check("POST", "/curve/smooth", 200, with(source, {{"level", 0.5}}));
        check(
            "POST",
            "/curve/edit",
            200,
            with(source, {{"level", 1}, {"control", {{"index", 1}, {"delta", {1, 2}}}}}));
        check("POST",
              "/curve/edit",
              200,
              with(source,
                   {{"portion", 0.5},
                    {"portion_unit", "fraction"},
                    {"drag", "full"},
                    {"point", {{"near", {5, 5}}, {"delta", {1, 2}}}}}));
        check("POST", "/curve/fit", 200, with(source, {{"pin_ends", false}}));
        check("POST", "/curve/approximate", 200, with(source, {{"tolerance", 9}}));
        check("POST",
              "/curve/approximate",
              200,
              with(source, {{"tolerance", 9}, {"mode", "c0"}, {"corners", "detect"}}));
        check("POST", "/curve/evaluate", 200, with(source, {{"count", 3}}));
        const int answered = source.contains("corners") ? 422 : 200;
        check("POST", "/curve/match", answered, with(source, {{"limit", 3}}));
        const json taken{{"coarse", apart["coarse"]},
                         {"details", apart["details"]},
                         {"closed", apart.value("closed", false)}};
        check("POST", "/curve/reconstruct", 200, taken);
        check("POST", "/curve/character", 200, with(source, {{"character", taken}}));
    }
    const json dot{{"points", {{1, 2}, {1, 2}, {1, 2}, {1, 2}}}, {"count", 2}};
    check("POST", "/curve/evaluate", 200, dot);
    check("POST", "/curve/smooth", 422, with(curve, {{"level", 9}}));
    check("POST", "/curve/smooth", 400, with(curve, {{"level", "x"}}));
    check("POST", "/curve/character", 404, with(curve, {{"character", "none"}}));
    const std::string built_in(curve::built_in_characters().front().name);
    check("POST", "/curve/character", 200, with(curve, {{"character", built_in}}));

    const std::string characters = "/curve/characters/{name}";
    check("PUT", characters, 201, stroke, "a");
    check("PUT", characters, 200, curve, "a");
    check("PUT", characters, 409, curve, built_in);
    check("PUT", characters, 200, with(stroke, {{"corners", "detect"}}), "a");
    check("GET", characters, 200, json(), "a");
    check("GET", characters, 200, json(), built_in);
    check("GET", "/curve/characters", 200, json());
    check("DELETE", characters, 204, json(), "a");
    check("DELETE", characters, 404, json(), "a");
    check("DELETE", characters, 409, json(), built_in);
    const std::string strokes = "/curve/strokes/{name}";
    const json drawn{{"samples", stroke["samples"]}};
    check("PUT", strokes, 201, drawn, "s");
    check("GET", strokes, 200, json(), "s");
    EXPECT_EQ(check("GET", "/curve/strokes", 200, json())["items"].size(), 1u);
    check("PUT", strokes, 422, stroke, "s");
    EXPECT_EQ(check("POST", "/curve/match", 200, drawn)["items"].size(), 1u);
    check("DELETE", strokes, 204, json(), "s");
    check("GET", strokes, 404, json(), "s");

    json grid = json::array();
    for (unsigned row = 0; row < 5; ++row) grid.push_back(random_points(7, 3, row));
    const json surface{{"points", grid}};
    check("POST",
          "/surface/reconstruct",
          200,
          check("POST", "/surface/decompose", 200, surface));
    check("POST",
          "/surface/edit",
          200,
          with(surface,
               {{"level", {1, 1.5}},
                {"control", {{"index", {1, 2}}, {"delta", {1, 2, 3}}}}}));
    check("POST", "/surface/decompose", 422, {{"points", json::array()}});
}

TEST(Openapi, RequestsThatAreTakenAreDescribed) {
    Interface interface;
    const std::string image = base64(text_of(jpeg_scene(1)));
    const auto request_schema = [](const std::string& name) {
        return document()["components"]["schemas"][name];
    };
    const json upload{{"image", image}, {"tags", {"a"}}, {"metadata", json::object()}};
    EXPECT_EQ(interface.post_json("/images", upload).status, 201);
    EXPECT_EQ(violation(upload, request_schema("ImageRequest"), document()),
              std::nullopt);
    const std::vector<json> queries{
        {{"image", image}, {"limit", 5}, {"seq", 3}, {"min_similarity", 0.5}},
        {{"id", 1}, {"m", 12}, {"mask", "none"}, {"explain", false}},
        {{"signature", json_of(interface.get("/images/1/signature"))}},
        {{"strokes",
          {{"width", 9},
           {"height", 9},
           {"background", nullptr},
           {"items",
            {{{"points", {{1, 2}, {3, 4}}},
              {"width", {1, 2.5}},
              {"color", "#aBcdef"}}}}}}},
    };
    for (const json& query : queries) {
        EXPECT_EQ(interface.post_json("/query", query).status, 200) << query;
        EXPECT_EQ(violation(query, request_schema("QueryRequest"), document()),
                  std::nullopt)
            << query;
    }
}

TEST(Openapi, IsServedWithATag) {
    Interface interface;
    const http::Response response = interface.get("/openapi.json");
    EXPECT_EQ(json_of(response), document());
    const std::string etag = header_of(response, "ETag");
    EXPECT_EQ(interface.get("/openapi.json", {{"If-None-Match", etag}}).status, 304);
    EXPECT_EQ(refusal_of(interface.get("/openapi.json?v=2")),
              (Refusal{400, "unknown_parameter", "v"}));
}

}  // namespace
}  // namespace haarmony::server
