#include "server/api/feedback.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/list_page.h"
#include "server/api/profile_json.h"
#include "server/api/training_pair_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kExportPage = 100;  // pairs of strokes may be long

std::optional<std::string> read_kind(Inputs& inputs) {
    std::optional<std::string> kind = inputs.text("kind");
    if (kind && !is_word(*kind))
        inputs.refuse("kind", "is not 1 to 64 of a-z, 0-9, _ and -");
    return kind;
}

json feedback_json(const schema::Feedback& feedback) {
    json members = pair_json(feedback);
    for (const char* name : {"signature", "strokes", "seconds"})
        if (!members.contains(name)) members[name] = nullptr;
    members["id"] = feedback.id;
    members["created_at"] = feedback.created_at;
    return members;
}

// Page after page, so that neither the server nor a lock holds all of it at once.
class Export {
  public:
    Export(ImageService& images,
           std::optional<std::string> kind,
           std::vector<schema::Feedback> first)
        : images_(images), kind_(std::move(kind)), page_(std::move(first)) {}

    std::optional<std::string> next() {
        if (page_.empty()) return {};
        std::string lines;
        for (const schema::Feedback& feedback : page_)
            if (stored_pair(feedback)) lines += pair_json(feedback).dump() + "\n";
        auto page = images_.feedback(kind_, page_.back().id, kExportPage);
        if (!page) throw std::runtime_error("feedback: " + page.error().message);
        page_ = std::move(page).value();
        return lines;
    }

  private:
    ImageService& images_;
    std::optional<std::string> kind_;
    std::vector<schema::Feedback> page_;
};

}  // namespace

Reply post_feedback(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    if (inputs->picture())
        return Error{
            ErrorCode::kUnsupportedFormat, "a picture is no training pair", "file"};
    auto read = read_pair(*std::move(inputs));
    if (!read) return read.problem();
    const auto id = context.images.add_feedback(read->feedback);
    if (!id) return id.error();
    http::Response response = http::json_response(201, {{"id", id.value()}});
    response.headers["Cache-Control"] = "no-store";
    return response;
}

Reply list_feedback(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const ListPlace place = ListPlace::read(*inputs);
    const auto kind = read_kind(*inputs);
    if (const auto problem = inputs->refused()) return *problem;

    const auto page = context.images.feedback(kind, place.cursor, place.fetched());
    if (!page) return page.error();
    http::Response response =
        http::json_response(200, list_page(*page, place, feedback_json));
    response.headers["Cache-Control"] = "no-store";
    return response;
}

Reply delete_feedback(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto removed = context.images.remove_feedback(to_int(*id));
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

Reply export_feedback(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const auto kind = read_kind(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    auto first = context.images.feedback(kind, {}, kExportPage);
    if (!first) return first.error();
    const auto source =
        std::make_shared<Export>(context.images, kind, std::move(first).value());
    http::Response response;
    response.headers["Content-Type"] = "application/jsonl";
    response.headers["Cache-Control"] = "no-store";
    response.body = http::ChunkSource([source] { return source->next(); });
    return response;
}

}  // namespace haarmony::server
