#include "server/http/json.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace haarmony::http {
namespace {

using nlohmann::json;

constexpr std::size_t kShown = 200;  // bytes of a complaint: it quotes the client's text

// Builds the value and refuses what the library's own builder lets pass: members that
// repeat, and depth.
class StrictBuilder : public nlohmann::json_sax<json> {
  public:
    json& root() { return root_; }
    [[nodiscard]] const std::string& complaint() const { return complaint_; }

    bool null() override { return place(nullptr) != nullptr; }
    bool boolean(bool value) override { return place(value) != nullptr; }
    bool number_integer(number_integer_t value) override {
        return place(value) != nullptr;
    }
    bool number_unsigned(number_unsigned_t value) override {
        return place(value) != nullptr;
    }
    bool number_float(number_float_t value, const string_t& /*text*/) override {
        return place(value) != nullptr;
    }
    bool string(string_t& value) override { return place(std::move(value)) != nullptr; }
    bool binary(binary_t& value) override { return place(std::move(value)) != nullptr; }
    bool start_object(std::size_t /*members*/) override { return open(json::object()); }
    bool start_array(std::size_t /*elements*/) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [member, added] =
            open_.back()->get_ref<json::object_t&>().emplace(std::move(name), nullptr);
        if (!added) {
            complaint_ =
                "JSON member '" + member->first.substr(0, kShown) + "' appears twice";
            return false;
        }
        member_ = &member->second;
        return true;
    }

    bool parse_error(std::size_t /*position*/,
                     const std::string& /*last_token*/,
                     const json::exception& error) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 3: ..."
        std::string text = error.what();
        const std::size_t bracket = text.find("] ");
        if (bracket != std::string::npos) text.erase(0, bracket + 2);
        complaint_ = "malformed JSON: " + text.substr(0, kShown);
        return false;
    }

  private:
    json* place(json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        if (open_.back()->is_array()) {
            auto& elements = open_.back()->get_ref<json::array_t&>();
            elements.push_back(std::move(value));
            return &elements.back();
        }
        *member_ = std::move(value);
        return member_;
    }

    bool open(json container) {
        if (open_.size() == kMaxJsonDepth) {
            complaint_ = "JSON is nested deeper than " + std::to_string(kMaxJsonDepth);
            return false;
        }
        open_.push_back(place(std::move(container)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    json root_;
    std::vector<json*> open_;  // the containers around the next value, outermost first
    json* member_ = nullptr;   // of the innermost object: waits for its value
    std::string complaint_;
};

}  // namespace

Result<json> parse_json(const std::string& text) {
    StrictBuilder builder;
    if (!json::sax_parse(text, &builder)) {
        return Error{.code = ErrorCode::kInvalidArgument,
                     .message = builder.complaint(),
                     .param = {}};
    }
    return std::move(builder.root());
}

std::string to_text(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

Response json_text_response(int status, std::string text) {
    Response response{.status = status, .headers = {}, .body = {}};
    response.headers["Content-Type"] = "application/json";
    response.body = std::move(text += '\n');
    return response;
}

Response json_response(int status, const json& value) {
    return json_text_response(status, to_text(value));
}

}  // namespace haarmony::http
