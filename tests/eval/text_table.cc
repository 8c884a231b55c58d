#include "tests/eval/text_table.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tests/eval/page.h"

namespace haarmony::eval {

TextTable::TextTable(std::vector<std::string> header, std::size_t labels)
    : labels_(labels), rows_{std::move(header)} {}

void TextTable::add(std::vector<std::string> cells) {
    assert(cells.size() == rows_.front().size());
    rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const auto& row : rows_) {
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string padding(widths[i] - row[i].size(), ' ');
            if (i > 0) line += "  ";
            line += i < labels_ ? row[i] + padding : padding + row[i];
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

std::string TextTable::html() const {
    HtmlTable table(rows_.front(), labels_);
    for (std::size_t i = 1; i < rows_.size(); ++i) table.add(rows_[i]);
    return table.html();
}

}  // namespace haarmony::eval
