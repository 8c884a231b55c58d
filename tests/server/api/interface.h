// The handlers behind their router, over a collection of a test's own: requests as text,
// replies as JSON.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/api/context.h"
#include "server/http/message.h"
#include "server/http/router.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {

class Interface {
  public:
    explicit Interface(std::vector<std::string> media_roots = {},
                       bool allow_url_fetch = false);

    // As the session does it: routed, then ETag and Range honoured.
    http::Response send(const std::string& method,
                        const std::string& target,
                        const http::Headers& headers = {},
                        const std::string& body = "");
    http::Response get(const std::string& target, const http::Headers& headers = {}) {
        return send("GET", target, headers);
    }
    http::Response post(const std::string& target,
                        const std::string& content_type,
                        const std::string& body) {
        return send("POST", target, {{"Content-Type", content_type}}, body);
    }
    http::Response post_json(const std::string& target, const nlohmann::json& body) {
        return post(target, "application/json", body.dump());
    }

    // Other jobs than the daemon's.
    void replace_jobs(std::unique_ptr<JobRunner> runner);
    // On a connection of its own.
    void sql(const std::string& statement);

    Collection collection;
    std::unique_ptr<VideoService> videos;  // outlives the jobs
    std::unique_ptr<JobRunner> jobs;
    std::unique_ptr<DuplicateGroups> duplicates;
    std::unique_ptr<ClusterOverview> clusters;
    std::unique_ptr<CurveService> curves;
    std::unique_ptr<FrameSearch> frames;

  private:
    MediaRoots media_roots_;
    bool allow_url_fetch_;
    std::unique_ptr<http::Router> router_;
    std::unique_ptr<Context> context_;
};

[[nodiscard]] std::string body_of(const http::Response& response);
// null where the body is no JSON.
[[nodiscard]] nlohmann::json json_of(const http::Response& response);
[[nodiscard]] std::string header_of(const http::Response& response,
                                    const std::string& name);

struct FormPart {
    std::string name;
    std::string body;
    std::string file_name = {};
};
inline constexpr std::string_view kFormType = "multipart/form-data; boundary=frontier";
[[nodiscard]] std::string form_of(const std::vector<FormPart>& parts);

// What a refusal says; empty strings where a member is missing.
struct Refusal {
    int status = 0;
    std::string code;
    std::string param;
    friend bool operator==(const Refusal&, const Refusal&) = default;
};
[[nodiscard]] Refusal refusal_of(const http::Response& response);
std::ostream& operator<<(std::ostream& out, const Refusal& refusal);

// By the letter of RFC 4648.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace haarmony::server
