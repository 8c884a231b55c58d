#include "tests/eval/page.h"

#include <gtest/gtest.h>

#include "tests/eval/test/xml_reader.h"

namespace haarmony::eval {
namespace {

std::string without_doctype(const std::string& html) {
    const std::string doctype = "<!DOCTYPE html>\n";
    EXPECT_TRUE(html.starts_with(doctype));
    return html.substr(doctype.size());
}

TEST(Page, IsWellFormedWithAnEntryForEachSection) {
    HtmlTable table({"name", "value"}, 1);
    table.add({"<b>", "1"});
    table.add({"x", "2"}, {false, true});
    const XmlReading reading = read_xml(without_doctype(page(
        "a & b",
        paragraph("5 < 6"),
        {{"one", "First", table.html()},
         {"two",
          "Second",
          panels({"x", "y"}) + small_panels({"z"}) + details("more", paragraph("p"))}})));
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.elements.at("section"), 2);
    EXPECT_EQ(reading.elements.at("td"), 4);
    EXPECT_EQ(reading.elements.count("b"), 0U);
    EXPECT_EQ(reading.attributes.at("href"), (std::vector<std::string>{"#one", "#two"}));
    EXPECT_EQ(reading.attributes.at("id"), (std::vector<std::string>{"one", "two"}));
}

TEST(Page, EscapesEveryCharacterThatMeansSomething) {
    EXPECT_EQ(escape("<a href=\"x\">'&'</a>"),
              "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(XmlReader, SeesWhatIsNotWellFormed) {
    EXPECT_EQ(read_xml("<p>a &amp; b<br/></p>").error, "");
    EXPECT_NE(read_xml("<p><b></p></b>").error, "");
    EXPECT_NE(read_xml("<p>").error, "");
    EXPECT_NE(read_xml("<p>a & b</p>").error, "");
    EXPECT_NE(read_xml("<p class=x></p>").error, "");
    EXPECT_NE(read_xml("a < b").error, "");
}

}  // namespace
}  // namespace haarmony::eval
