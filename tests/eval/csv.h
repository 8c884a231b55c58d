// Tables as comma-separated values.
//
// Shape   a header line and one line a row, all of the header's width; lines end in \n.
//         Cells with a comma, a quote or a line break are quoted (RFC 4180).
// Units   numbers in the C locale, at most six digits after the point.
// Errors  a row of another width and a number that is not finite are a caller's bug and
//         assert.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace haarmony::eval {

// A number as text, without needless zeros: 0.25, 100, 3.
// Requires: value is finite; 0 <= digits <= 9, the most after the point.
[[nodiscard]] std::string number(double value, int digits);

// With a power of ten, for values of any size: 2.1e-13, 0.0e+00.
// Requires: value is finite; 0 <= digits <= 9, after the point.
[[nodiscard]] std::string scientific(double value, int digits);

class CsvCell {
  public:
    CsvCell(std::string_view text) : text_(text) {}
    CsvCell(const std::string& text) : text_(text) {}
    CsvCell(const char* text) : text_(text) {}
    CsvCell(double value) : text_(number(value, 6)) {}
    CsvCell(std::integral auto value) : text_(std::to_string(value)) {}

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
};

class CsvTable {
  public:
    explicit CsvTable(const std::vector<CsvCell>& header);

    void add(const std::vector<CsvCell>& row);
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::size_t width_ = 0;
    std::string text_;
};

}  // namespace haarmony::eval
