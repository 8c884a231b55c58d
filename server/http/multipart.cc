#include "server/http/multipart.h"

#include <cstddef>
#include <utility>

#include "server/http/header_value.h"
#include "server/http/message.h"
#include "server/http/target.h"

namespace haarmony::http {
namespace {

constexpr std::size_t kMaxBoundary = 70;       // RFC 2046 section 5.1.1
constexpr std::size_t kMaxPartHeader = 8'192;  // bytes of the headers of one part
constexpr std::size_t kShown = 100;            // bytes of the client's text in an error

Error refuse(std::string what, std::string_view text) {
    what += ": '";
    what += text.substr(0, kShown);
    what += '\'';
    return Error{
        .code = ErrorCode::kInvalidArgument, .message = std::move(what), .param = {}};
}

Error refuse(std::string what) {
    return Error{
        .code = ErrorCode::kInvalidArgument, .message = std::move(what), .param = {}};
}

bool is_boundary(std::string_view text) {
    static constexpr std::string_view kPunctuation = "'()+_,-./:=? ";
    if (text.empty() || text.size() > kMaxBoundary || text.back() == ' ') return false;
    for (const char c : text) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool digit = c >= '0' && c <= '9';
        if (!letter && !digit && kPunctuation.find(c) == std::string_view::npos)
            return false;
    }
    return true;
}

// Names and file names: what browsers write, which is a quoted string whose quotes and line
// ends are percent-encoded (RFC 7578 section 4.2 and the HTML standard).
std::string unescape_name(std::string_view text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string_view escape = text.substr(i, 3);
        const char c = escape == "%22"                      ? '"'
                       : escape == "%0D" || escape == "%0d" ? '\r'
                       : escape == "%0A" || escape == "%0a" ? '\n'
                                                            : '\0';
        if (c != '\0') i += 2;
        name.push_back(c != '\0' ? c : text[i]);
    }
    return name;
}

// Content-Disposition: form-data; name="..."; filename="..."
Result<void> read_disposition(std::string_view value, Part& part) {
    Result<ParameterizedValue> parsed = parse_parameterized(value);
    if (!parsed) return std::move(parsed).error();
    if (parsed->value != "form-data") {
        return refuse("multipart part is not form-data", parsed->value);
    }
    bool named = false;
    for (const auto& [name, text] : parsed->parameters) {
        if (name == "name") {
            part.name = unescape_name(text);
            named = true;
        } else if (name == "filename") {
            part.file_name = unescape_name(text);
        } else if (name == "filename*") {
            return refuse("multipart part with 'filename*', which RFC 7578 forbids",
                          text);
        }
    }
    if (!named || part.name.empty())
        return refuse("multipart part without a name", value);
    if (!is_utf8(part.name)) return refuse("multipart name is not UTF-8", part.name);
    return {};
}

Result<void> read_part_header(std::string_view line, Part& part, bool& disposed) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) {
        return refuse("malformed header in a multipart part", line);
    }
    const std::string name = lower_case(line.substr(0, colon));
    const std::string_view value = trim(line.substr(colon + 1));
    if (has_control(value))
        return refuse("control character in a multipart header", line);
    if (name == "content-disposition") {
        if (disposed) return refuse("multipart part with two Content-Dispositions", line);
        disposed = true;
        return read_disposition(value, part);
    }
    if (name == "content-type") {
        if (!part.content_type.empty()) {
            return refuse("multipart part with two Content-Types", line);
        }
        part.content_type = value;
    } else if (name == "content-transfer-encoding") {
        const std::string encoding = lower_case(value);
        if (encoding != "binary" && encoding != "8bit" && encoding != "7bit") {
            return refuse("multipart part with a Content-Transfer-Encoding", value);
        }
    }
    return {};  // others must be ignored (RFC 7578 section 4.8)
}

// Takes "Name: value" lines up to and with the empty one off the front of `rest`.
Result<void> read_part_headers(std::string_view& rest, Part& part) {
    bool disposed = false;
    std::size_t bytes = 0;
    for (;;) {
        const std::size_t end = rest.find("\r\n");
        if (end == std::string_view::npos) return refuse("multipart headers have no end");
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end + 2);
        if (line.empty()) break;
        bytes += line.size();
        if (bytes > kMaxPartHeader) return refuse("multipart headers are too long", line);
        if (Result<void> read = read_part_header(line, part, disposed); !read)
            return read;
    }
    if (!disposed) return refuse("multipart part without Content-Disposition");
    return {};
}

// What may follow a delimiter on its line: nothing but spaces and tabs (RFC 2046).
bool skip_padding(std::string_view& rest) {
    const std::size_t end = rest.find_first_not_of(" \t");
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end);
    if (!rest.starts_with("\r\n")) return false;
    rest.remove_prefix(2);
    return true;
}

Result<std::string> boundary_of(std::string_view content_type) {
    Result<ParameterizedValue> parsed = parse_parameterized(content_type);
    if (!parsed) return std::move(parsed).error();
    if (parsed->value != "multipart/form-data") {
        return refuse("not multipart/form-data", parsed->value);
    }
    for (auto& [name, text] : parsed->parameters) {
        if (name != "boundary") continue;
        if (!is_boundary(text)) return refuse("bad multipart boundary", text);
        return std::move(text);
    }
    return refuse("multipart/form-data without a boundary", content_type);
}

}  // namespace

Result<std::vector<Part>> parse_multipart(std::string_view content_type,
                                          std::string_view body) {
    const Result<std::string> boundary = boundary_of(content_type);
    if (!boundary) return boundary.error();
    const std::string opening = "--" + *boundary;
    const std::string delimiter = "\r\n" + opening;

    // RFC 2046 lets a preamble stand here, which HTTP has no use for: of it, only the line
    // end that some clients write is taken.
    std::string_view rest = body;
    if (rest.starts_with("\r\n")) rest.remove_prefix(2);
    if (!rest.starts_with(opening)) {
        return refuse("multipart body does not begin with its boundary", *boundary);
    }
    rest.remove_prefix(opening.size());

    std::vector<Part> parts;
    for (;;) {
        if (rest.starts_with("--")) {
            rest.remove_prefix(2);
            if (!rest.empty() && rest != "\r\n") {
                return refuse("multipart body goes on after its end", rest);
            }
            return parts;
        }
        if (!skip_padding(rest)) {
            return refuse("malformed line after a multipart boundary", rest);
        }
        if (parts.size() == kMaxParts) {
            return refuse("multipart body with more than " + std::to_string(kMaxParts) +
                          " parts");
        }
        Part part;
        if (Result<void> read = read_part_headers(rest, part); !read) return read.error();
        // A line that begins with the delimiter ends the part whatever follows on it (RFC
        // 2046 section 5.1.1), so a sender must choose a boundary that no part contains.
        const std::size_t end = rest.find(delimiter);
        if (end == std::string_view::npos) {
            return refuse("multipart part '" + part.name + "' has no end");
        }
        part.body = rest.substr(0, end);
        rest.remove_prefix(end + delimiter.size());
        parts.push_back(std::move(part));
    }
}

}  // namespace haarmony::http
