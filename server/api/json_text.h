// JSON objects written straight into a string, for replies of hundreds of members: building
// values first and writing them afterwards takes longer there than the search.
//
// Shape    http::parse_json() reads back what was written: integers, numbers with a fraction
//          or an exponent in the fewest digits that name the same double, strings.
// Errors   none: as http::json_response(), bytes that are not UTF-8 become U+FFFD; a number
//          that is not finite becomes null.
// Threads  values.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace haarmony::server {

// One object at the end of a string that outlives it. Requires: each name once, of letters
// and '_'; end() once, and nothing else is written to the string before it.
class JsonObject {
  public:
    explicit JsonObject(std::string& out);

    JsonObject& text(std::string_view name, std::string_view value);
    JsonObject& text_or_null(std::string_view name, std::string_view value);
    JsonObject& texts(std::string_view name, std::span<const std::string> values);
    JsonObject& integer(std::string_view name, std::int64_t value);
    JsonObject& number(std::string_view name, double value);
    JsonObject& boolean(std::string_view name, bool value);
    // Of JSON that is written already.
    JsonObject& json(std::string_view name, std::string_view value);
    void end();

  private:
    void name(std::string_view name);

    std::string& out_;
    bool first_ = true;
};

}  // namespace haarmony::server
