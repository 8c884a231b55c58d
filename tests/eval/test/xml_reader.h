// Whether a text is well-formed, as far as the evaluation's pages go: elements that nest and
// close, attributes in double quotes, known character references, no bare < or &.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace haarmony::eval {

struct XmlReading {
    std::string error;                                           // empty: well-formed
    std::map<std::string, int> elements;                         // how many of each name
    std::map<std::string, std::vector<std::string>> attributes;  // values by name
};

[[nodiscard]] XmlReading read_xml(std::string_view text);

}  // namespace haarmony::eval
