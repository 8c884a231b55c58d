#include "tests/eval/page.h"

#include <cassert>

namespace haarmony::eval {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark;
  --paper: #ffffff; --ink: #1c1f24; --soft: #5b626d; --rule: #d8dce2; --wash: #f3f5f8;
  --c0: #0b57d0; --c1: #c62f3b; --c2: #2b7a33; --c3: #a86200; --c4: #7b3fa0;
  --c5: #00798a; --c6: #6b4f3a; --c7: #b3186b; --c8: #5f6b00; --c9: #555b66; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #14171c; --ink: #e6e9ee; --soft: #a3abb8; --rule: #353b45; --wash: #1d2128;
  --c0: #7ab7ff; --c1: #ff8a8f; --c2: #7fd987; --c3: #ffb74d; --c4: #cba2f5;
  --c5: #5fd4de; --c6: #d0ac91; --c7: #ff86bd; --c8: #cfdc55; --c9: #b9c0cc; } }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem; background: var(--paper);
  color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; }
h2 { margin-top: 3rem; border-bottom: 1px solid var(--rule); padding-bottom: 0.3rem; }
p, nav { max-width: 48rem; }
nav ul { columns: 2; padding-left: 1.2rem; }
a { color: var(--c0); }
.panels { display: grid; gap: 1rem; margin: 1rem 0;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 21rem), 1fr)); }
.panels.small { grid-template-columns: repeat(auto-fit, minmax(min(100%, 15rem), 1fr)); }
.plot { width: 100%; height: auto; max-width: 32rem; }
.plot text { fill: var(--ink); font: 10px system-ui, sans-serif; }
.plot text.tick { fill: var(--soft); }
.plot text.label { font-size: 11px; }
.plot text.heading { font-size: 12px; font-weight: 600; }
.middle { text-anchor: middle; } .end { text-anchor: end; }
.grid { stroke: var(--rule); stroke-width: 0.6; }
.axis { stroke: var(--soft); stroke-width: 1; }
.line { fill: none; stroke: var(--c); stroke-width: 1.7; stroke-linejoin: round; }
.mark { fill: var(--c); stroke: var(--paper); stroke-width: 0.6; }
.band { fill: var(--c); opacity: 0.13; }
.fine { stroke-width: 0.9; } .ghost { stroke-width: 1.1; opacity: 0.45; }
.ribbon { fill: var(--c); }
.joint { stroke: var(--c); stroke-width: 2.4; stroke-linecap: round; }
.sizes { display: flex; flex-wrap: wrap; gap: 1.5rem; align-items: end; margin: 1rem 0; }
.sizes div { max-width: 100%; overflow-x: auto; }
.c0 { --c: var(--c0); } .c1 { --c: var(--c1); } .c2 { --c: var(--c2); }
.c3 { --c: var(--c3); } .c4 { --c: var(--c4); } .c5 { --c: var(--c5); }
.c6 { --c: var(--c6); } .c7 { --c: var(--c7); } .c8 { --c: var(--c8); }
.c9 { --c: var(--c9); }
.legend { display: flex; flex-wrap: wrap; gap: 0.2rem 1.2rem; margin: 0.5rem 0;
  padding: 0; list-style: none; font-size: 0.85rem; }
.legend svg { vertical-align: middle; }
.wide { overflow-x: auto; margin: 1rem 0; }
td { white-space: nowrap; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid var(--rule); text-align: left; }
th { vertical-align: bottom; background: var(--wash); }
.n { text-align: right; }
td.strong { font-weight: 700; color: var(--c0); }
summary { cursor: pointer; color: var(--c0); }
)";

std::string element(std::string_view name,
                    std::string_view css,
                    std::string_view content) {
    std::string html = '<' + std::string(name);
    if (!css.empty()) html += " class=\"" + std::string(css) + '"';
    return html + '>' + std::string(content) + "</" + std::string(name) + '>';
}

}  // namespace

std::string escape(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string page(const std::string& title,
                 const std::string& introduction,
                 const std::vector<Section>& sections) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
    html += element("title", "", escape(title)) + '\n';
    html += element("style", "", kStyle) + "\n</head>\n<body>\n";
    html += element("h1", "", escape(title)) + '\n' + introduction;
    html += "<nav><ul>\n";
    for (const Section& section : sections) {
        html += "<li><a href=\"#" + section.anchor + "\">" + escape(section.title) +
                "</a></li>\n";
    }
    html += "</ul></nav>\n";
    for (const Section& section : sections) {
        html += "<section id=\"" + section.anchor + "\">\n" +
                element("h2", "", escape(section.title)) + '\n' + section.html +
                "</section>\n";
    }
    return html + "</body>\n</html>\n";
}

std::string_view style_sheet() { return kStyle; }

std::string paragraph(std::string_view text) {
    return element("p", "", escape(text)) + '\n';
}

std::string panels(const std::vector<std::string>& elements) {
    std::string html = "<div class=\"panels\">\n";
    for (const std::string& content : elements)
        html += element("div", "", content) + '\n';
    return html + "</div>\n";
}

std::string small_panels(const std::vector<std::string>& elements) {
    std::string html = "<div class=\"panels small\">\n";
    for (const std::string& content : elements)
        html += element("div", "", content) + '\n';
    return html + "</div>\n";
}

std::string details(std::string_view summary, const std::string& html) {
    return "<details>" + element("summary", "", escape(summary)) + '\n' + html +
           "</details>\n";
}

HtmlTable::HtmlTable(const std::vector<std::string>& header, std::size_t labels)
    : width_(header.size()), labels_(labels) {
    html_ = "<thead><tr>";
    for (std::size_t i = 0; i < header.size(); ++i)
        html_ += element("th", i < labels_ ? "" : "n", escape(header[i]));
    html_ += "</tr></thead>\n<tbody>\n";
}

void HtmlTable::add(const std::vector<std::string>& cells,
                    const std::vector<bool>& strong) {
    assert(cells.size() == width_ && (strong.empty() || strong.size() == width_));
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::string css = i < labels_ ? "" : "n";
        if (!strong.empty() && strong[i]) css += css.empty() ? "strong" : " strong";
        html_ += element("td", css, escape(cells[i]));
    }
    html_ += "</tr>\n";
}

std::string HtmlTable::html() const {
    return "<div class=\"wide\"><table>" + html_ + "</tbody></table></div>\n";
}

}  // namespace haarmony::eval
