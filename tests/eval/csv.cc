#include "tests/eval/csv.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace haarmony::eval {
namespace {

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
    std::string result = "\"";
    for (const char c : cell) {
        if (c == '"') result += '"';
        result += c;
    }
    return result + '"';
}

}  // namespace

std::string number(double value, int digits) {
    assert(std::isfinite(value) && digits >= 0 && digits <= 9);
    std::array<char, 350> buffer{};  // the largest double has 309 digits
    const auto [end, error] = std::to_chars(buffer.data(),
                                            buffer.data() + buffer.size(),
                                            value,
                                            std::chars_format::fixed,
                                            digits);
    assert(error == std::errc{});
    std::string text(buffer.data(), end);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string scientific(double value, int digits) {
    assert(std::isfinite(value) && digits >= 0 && digits <= 9);
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(),
                                            buffer.data() + buffer.size(),
                                            value,
                                            std::chars_format::scientific,
                                            digits);
    assert(error == std::errc{});
    return {buffer.data(), end};
}

CsvTable::CsvTable(const std::vector<CsvCell>& header) : width_(header.size()) {
    add(header);
}

void CsvTable::add(const std::vector<CsvCell>& row) {
    assert(row.size() == width_);
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (i > 0) text_ += ',';
        text_ += quoted(row[i].text());
    }
    text_ += '\n';
}

}  // namespace haarmony::eval
