// The page of results: one file, readable in light and dark, with nothing from elsewhere.
//
// Shape   HTML that is also well-formed XML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace haarmony::eval {

// &, <, >, " and ' as character references.
[[nodiscard]] std::string escape(std::string_view text);

struct Section {
    std::string anchor;  // a word, for the list of contents
    std::string title;
    std::string html;
};

[[nodiscard]] std::string page(const std::string& title,
                               const std::string& introduction,
                               const std::vector<Section>& sections);

// The style sheet of the page, for a plot (plot_svg.h) that stands alone.
[[nodiscard]] std::string_view style_sheet();

[[nodiscard]] std::string paragraph(std::string_view text);

// Panels side by side.
[[nodiscard]] std::string panels(const std::vector<std::string>& elements);

// The same, four to a row where there is room.
[[nodiscard]] std::string small_panels(const std::vector<std::string>& elements);

// Hidden until it is opened.
[[nodiscard]] std::string details(std::string_view summary, const std::string& html);

class HtmlTable {
  public:
    // The first `labels` columns are text, the others numbers.
    HtmlTable(const std::vector<std::string>& header, std::size_t labels);

    // Requires: as many cells as the header has. `strong` ones stand out.
    void add(const std::vector<std::string>& cells, const std::vector<bool>& strong = {});
    [[nodiscard]] std::string html() const;

  private:
    std::size_t width_;
    std::size_t labels_;
    std::string html_;
};

}  // namespace haarmony::eval
