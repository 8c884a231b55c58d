#include "tests/eval/test/xml_reader.h"

#include <regex>

namespace haarmony::eval {
namespace {

bool has_bare_ampersand(const std::string& text) {
    static const std::regex reference("&(amp|lt|gt|quot|#39);");
    return std::regex_replace(text, reference, "").find('&') != std::string::npos;
}

}  // namespace

XmlReading read_xml(std::string_view text) {
    static const std::regex tag(
        R"(^<(/?)([a-z][a-z0-9]*)((?:\s+[a-zA-Z][a-zA-Z0-9-]*="[^"<]*")*)\s*(/?)>$)");
    static const std::regex attribute(R"(([a-zA-Z][a-zA-Z0-9-]*)="([^"<]*)\")");
    XmlReading reading;
    std::vector<std::string> open;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t start = std::min(text.find('<', at), text.size());
        const std::string between(text.substr(at, start - at));
        if (has_bare_ampersand(between)) reading.error = "bare &: " + between;
        if (start == text.size()) break;
        const std::size_t end = text.find('>', start);
        const std::string whole(
            text.substr(start, end == std::string_view::npos ? end : end - start + 1));
        at = start + whole.size();
        std::smatch parts;
        if (!std::regex_match(whole, parts, tag) || has_bare_ampersand(whole)) {
            reading.error = "no tag: " + whole;
            return reading;
        }
        if (parts[1].length() > 0) {
            if (open.empty() || open.back() != parts[2]) {
                reading.error = "closes nothing: " + whole;
                return reading;
            }
            open.pop_back();
            continue;
        }
        ++reading.elements[parts[2]];
        const std::string attributes = parts[3];
        for (std::sregex_iterator it(attributes.begin(), attributes.end(), attribute),
             none;
             it != none;
             ++it) {
            reading.attributes[(*it)[1]].push_back((*it)[2]);
        }
        if (parts[4].length() == 0) open.push_back(parts[2]);
    }
    if (!open.empty()) reading.error = "never closed: " + open.back();
    return reading;
}

}  // namespace haarmony::eval
