#include "server/http/json.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
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
    explicit StrictBuilder(std::string_view text) : text_(text) {}

    json& root() { return root_; }
    [[nodiscard]] const std::string& complaint() const { return complaint_; }
    // Of the number that is not finite, if that is the complaint.
    [[nodiscard]] const std::string& place() const { return place_; }

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

    bool parse_error(std::size_t position,
                     const std::string& last_token,
                     const json::exception& error) override {
        if (const std::string_view number = not_finite(position, last_token);
            !number.empty()) {
            place_ = next_place();
            complaint_ = place_ + " '" + std::string(number.substr(0, kShown)) +
                         "' is not a finite number";
            return false;
        }
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

    // The text of a number too large for a double, or one of the words that many writers
    // use though JSON has none; else nothing. The parser has read up to `position`: all of
    // such a number, the token, and of such a word what is no other token's beginning.
    [[nodiscard]] std::string_view not_finite(std::size_t position,
                                              const std::string& last_token) const {
        constexpr std::pair<std::string_view, std::size_t> kWords[] = {
            {"NaN", 1}, {"-Infinity", 2}, {"Infinity", 1}};
        for (const auto& [word, read] : kWords)
            if (position >= read && position <= text_.size() &&
                text_.substr(position - read).starts_with(word))
                return word;
        double value = 0;
        const char* const end = last_token.data() + last_token.size();
        const auto [stop, failure] = std::from_chars(last_token.data(), end, value);
        return failure == std::errc::result_out_of_range && stop == end
                   ? std::string_view(last_token)
                   : std::string_view();
    }

    // Where the next value goes: "points[3][1]".
    [[nodiscard]] std::string next_place() const {
        std::string path;
        for (std::size_t depth = 0; depth < open_.size(); ++depth) {
            const bool innermost = depth + 1 == open_.size();
            const json* next = innermost ? member_ : open_[depth + 1];
            if (open_[depth]->is_array()) {
                const std::size_t index = open_[depth]->size() - (innermost ? 0 : 1);
                path += '[' + std::to_string(index) + ']';
                continue;
            }
            for (const auto& [name, value] : open_[depth]->items())
                if (&value == next) path += (path.empty() ? "" : ".") + name;
        }
        return path;
    }

    std::string_view text_;
    json root_;
    std::vector<json*> open_;  // the containers around the next value, outermost first
    json* member_ = nullptr;   // of the innermost object: waits for its value
    std::string complaint_;
    std::string place_;
};

}  // namespace

Result<json> parse_json(const std::string& text) {
    StrictBuilder builder(text);
    if (!json::sax_parse(text, &builder)) {
        return Error{.code = ErrorCode::kInvalidArgument,
                     .message = builder.complaint(),
                     .param = builder.place()};
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
