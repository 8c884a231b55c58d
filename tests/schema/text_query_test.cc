#include "schema/text_query.h"

#include <gtest/gtest.h>

#include <random>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

class TextQuery : public testing::Test {
  protected:
    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
};

TEST_F(TextQuery, IsQuotedPiecesWithStarsBehindPrefixes) {
    const std::pair<std::string, std::string> cases[] = {
        {"cat", R"("cat")"},
        {"  red\tcar\n", R"("red" "car")"},
        {R"("red car")", R"("red car")"},
        {R"(my "red car" blue)", R"("my" "red car" "blue")"},
        {R"(never "closed here)", R"("never" "closed here")"},
        {R"(a"b c"d)", R"("a" "b c" "d")"},
        {"summ*", R"("summ"*)"},
        {R"("red ca"* x)", R"("red ca"* "x")"},
        {R"("red ca*")", R"("red ca*")"},
        {"cat *", R"("cat")"},
        {"!!! cat -- \"...\"", R"("cat")"},
        {"a OR b AND NOT c", R"("a" "OR" "b" "AND" "NOT" "c")"},
        {"uri:cat ^dog NEAR(a,b) {x}", R"q("uri:cat" "^dog" "NEAR(a,b)" "{x}")q"},
        {std::string("a\0b", 3), R"("a" "b")"},
        {std::string("\"a\0b\"", 5), R"("a b")"},
    };
    for (const auto& [text, query] : cases) {
        EXPECT_EQ(expect(text_query(database_.handle(), text)), query) << text;
    }
}

TEST_F(TextQuery, ATextWithoutAWordIsNamed) {
    for (const std::string text : {"", "   ", "*", "\"\"", "!!! ?", "- \"_\"* ^", "\""}) {
        const auto refused = text_query(database_.handle(), text);
        ASSERT_FALSE(refused) << text;
        EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(refused.error().param, "text");
        EXPECT_NE(refused.error().message.find('"' + text + '"'), std::string::npos)
            << refused.error().message;
    }
}

TEST_F(TextQuery, AsMuchTextAsAllowedWorksAndOneByteMoreIsNamed) {
    std::string text;
    while (text.size() + 2 <= kMaxTextBytes) text += "a ";
    ImageStore store(database_);
    EXPECT_TRUE(store.matching({.text = text, .tags = {}}));
    EXPECT_TRUE(store.matching({.text = std::string(kMaxTextBytes, 'a'), .tags = {}}));
    const auto refused = store.matching({.text = text + "b", .tags = {}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(refused.error().message.find(std::to_string(kMaxTextBytes + 1)),
              std::string::npos);
}

// Whatever is typed, the full-text search never sees an error in it.
TEST_F(TextQuery, NoBytesAreASyntaxError) {
    ImageStore store(database_);
    const ImageId all = expect(store.add(file_picture(1)));
    const std::string pieces[] = {
        "\"",   "*",    "(", ")", ":", "^", "+",  "-",  "{", "}",    "AND ", "OR ",
        "NOT ", "NEAR", "a", " ", "'", ",", "\\", "\0", ";", "\xff", "\xc3", "uri"};
    std::mt19937 random(7);
    int answered = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text = random() % 2 == 0 ? "all " : "";
        for (auto i = random() % 12; i > 0; --i) {
            text += random() % 8 == 0 ? std::string(1, static_cast<char>(random()))
                                      : pieces[random() % std::size(pieces)];
        }
        if (text.empty()) continue;
        const auto found = store.matching({.text = text, .tags = {}});
        if (found) {
            ++answered;
            EXPECT_LE(found->size(), 1u);
        } else {
            EXPECT_EQ(found.error().code, ErrorCode::kInvalidArgument) << text;
            EXPECT_NE(found.error().message.find("no word"), std::string::npos)
                << found.error().message;
        }
    }
    EXPECT_GT(answered, 1000);
    EXPECT_EQ(expect(store.matching({.text = "all", .tags = {}})), std::vector{all});
}

}  // namespace
}  // namespace haarmony::schema
