// One table for the terminal and for a page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace haarmony::eval {

class TextTable {
  public:
    // The first `labels` columns are text, the others numbers.
    TextTable(std::vector<std::string> header, std::size_t labels);

    // Requires: as many cells as the header has.
    void add(std::vector<std::string> cells);

    // Columns of even width, numbers to the right; lines end in \n.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string html() const;

  private:
    std::size_t labels_;
    std::vector<std::vector<std::string>> rows_;  // the header first
};

}  // namespace haarmony::eval
