#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TextSearch : public testing::Test {
  protected:
    [[nodiscard]] ImageId add(const std::string& uri,
                              std::vector<std::string> tags = {},
                              const std::string& metadata = "{}") {
        NewImage image = file_picture(++number_);
        image.uri = uri;
        image.tags = std::move(tags);
        image.metadata = metadata;
        return expect(store_.add(image));
    }
    [[nodiscard]] std::vector<ImageId> found(const std::string& text,
                                             std::vector<std::string> tags = {}) {
        return expect(store_.matching({.text = text, .tags = std::move(tags)}));
    }
    // The index says what the stored text says, and the stored text what the tables say.
    void expect_consistent() {
        sqlite3* handle = database_.handle();
        EXPECT_NO_THROW(run_sql(handle,
                                "INSERT INTO image_text (image_text) VALUES"
                                " ('integrity-check')"));
        const std::string stored = "SELECT rowid, uri, tags, metadata FROM image_text";
        const std::string derived = "SELECT id, uri, tags, metadata FROM image_words";
        for (const auto& [left, right] :
             {std::pair(stored, derived), std::pair(derived, stored)}) {
            EXPECT_EQ(
                sql_integer(handle,
                            "SELECT count(*) FROM (" + left + " EXCEPT " + right + ")"),
                0);
        }
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
    int number_ = 0;
};

TEST_F(TextSearch, FindsWordsOfFileNamesTagsAndMetadataValues) {
    const ImageId cat = add("file:///Holiday%202019/my%20Cat_07.jpg");
    const ImageId dog = add("file:///dogs/rex.png", {"Lake Garda", "holiday"});
    const ImageId sea = add(
        "s3.png",
        {"b-w"},
        R"({"title":"The caf\u00e9","deep":{"list":["Holiday",{"a":"ship"}]},"n":42,"ok":true})");
    EXPECT_THAT(found("holiday"), ElementsAre(cat, dog, sea));
    EXPECT_THAT(found("HOLIDAY 2019"), ElementsAre(cat));
    EXPECT_THAT(found("cat"), ElementsAre(cat));
    EXPECT_THAT(found("garda"), ElementsAre(dog));
    EXPECT_THAT(found("ship cafe"), ElementsAre(sea));
    EXPECT_THAT(found("caf\xc3\x89"), ElementsAre(sea));
    // All words, wherever each of them stands.
    EXPECT_THAT(found("rex holiday"), ElementsAre(dog));
    EXPECT_THAT(found("rex ship"), IsEmpty());
    // Keys, numbers and truth values are no words; nor is the scheme of a uri.
    for (const std::string text : {"title", "deep", "42", "true", "file"}) {
        EXPECT_THAT(found(text), IsEmpty()) << text;
    }
}

TEST_F(TextSearch, PhrasesStayWithinOneTagOrValue) {
    const ImageId a = add("file:///x", {"red car", "blue"});
    const ImageId b =
        add("file:///y", {"car blue", "red"}, R"({"a":"one two","b":"six"})");
    EXPECT_THAT(found("\"red car\""), ElementsAre(a));
    EXPECT_THAT(found("red car"), ElementsAre(a, b));
    // Tags stand in their order: blue, red car; car blue, red.
    EXPECT_THAT(found("\"blue red\""), IsEmpty());
    EXPECT_THAT(found("\"two six\""), IsEmpty());
    EXPECT_THAT(found("\"one two\" six"), ElementsAre(b));
    EXPECT_THAT(found("red-car"), ElementsAre(a));
}

TEST_F(TextSearch, AStarMakesAPrefix) {
    const ImageId a = add("file:///summer-house.jpg");
    const ImageId b = add("file:///summit%20cross.jpg");
    EXPECT_THAT(found("summ*"), ElementsAre(a, b));
    EXPECT_THAT(found("summ"), IsEmpty());
    EXPECT_THAT(found("\"summer ho\"*"), ElementsAre(a));
    EXPECT_THAT(found("s* cr*"), ElementsAre(b));
}

TEST_F(TextSearch, OnlySearchablePicturesAreFound) {
    const ImageId failed = add("file:///photos/cat1.jpg", {"cat"});
    const ImageId deleted = add("file:///photos/cat2.jpg", {"cat"});
    const ImageId purged = add("file:///photos/cat3.jpg", {"cat"});
    const ImageId kept = add("file:///photos/cat4.jpg", {"cat"});
    expect(store_.mark_failed("file:///photos/cat1.jpg", {}, "cut"));
    expect(store_.remove(deleted));
    expect(store_.purge(purged));
    EXPECT_THAT(found("cat"), ElementsAre(kept));
    expect_consistent();
    expect(store_.update(failed, file_picture(1)));
    EXPECT_THAT(found("cat1"), ElementsAre(failed));
    EXPECT_THAT(found("", {"cat"}), ElementsAre(failed, kept));
    expect_consistent();
}

TEST_F(TextSearch, AWriterThatForgetsItIsRecordedByTheTriggers) {
    static_cast<void>(add("file:///one.jpg", {"old"}));
    static_cast<void>(add("file:///two.jpg", {"old"}));
    static_cast<void>(add("file:///three.jpg", {"old"}));
    const RawConnection other(folder_.file("x.db"));
    run_sql(other.handle(), "PRAGMA foreign_keys = ON");
    run_sql(other.handle(), "UPDATE images SET uri = 'file:///uno.jpg' WHERE id = 1");
    run_sql(other.handle(), "INSERT INTO image_tags VALUES (1, 'fresh')");
    run_sql(other.handle(), "UPDATE image_tags SET tag = 'young' WHERE image_id = 2");
    run_sql(other.handle(), "UPDATE image_tags SET image_id = 1 WHERE image_id = 2");
    run_sql(other.handle(), "DELETE FROM images WHERE id = 3");
    EXPECT_THAT(found("uno fresh young"), ElementsAre(ImageId{1}));
    EXPECT_THAT(found("old"), ElementsAre(ImageId{1}));
    EXPECT_THAT(found("three"), IsEmpty());
    run_sql(other.handle(), "DELETE FROM image_tags");
    EXPECT_THAT(found("fresh"), IsEmpty());
    EXPECT_THAT(found("uno"), ElementsAre(ImageId{1}));
    expect_consistent();
}

TEST_F(TextSearch, ListHonoursTextAndTagsPageByPage) {
    std::vector<ImageId> want;
    for (int i = 0; i < 30; ++i) {
        const bool has_word = i % 2 == 0;
        const bool has_tag = i % 3 == 0;
        const ImageId id = add(
            "file:///" + std::string(has_word ? "cat" : "dog") + std::to_string(i) +
                (has_word ? "/cat" : "/dog"),
            has_tag ? std::vector<std::string>{"t", "u"} : std::vector<std::string>{"u"});
        if (has_word && has_tag) want.push_back(id);
    }
    std::vector<ImageId> seen;
    ListOptions page{
        .limit = 2, .after = std::nullopt, .tags = {"u", "t"}, .text = "cat"};
    for (;;) {
        const auto images = expect(store_.list(page));
        if (images.empty()) break;
        EXPECT_LE(images.size(), 2u);
        for (const Image& image : images) {
            seen.push_back(image.id);
            EXPECT_THAT(image.tags, ElementsAre("t", "u"));
        }
        page.after = images.back().id;
    }
    EXPECT_EQ(seen, want);
    EXPECT_EQ(found("cat", {"t", "u"}), want);
    EXPECT_EQ(expect(store_.matching({})).size(), 30u);
}

TEST_F(TextSearch, WhatCannotBeAskedForIsNamedByListAndMatching) {
    const ListOptions options{
        .limit = 5, .after = std::nullopt, .tags = {}, .text = "?!"};
    EXPECT_EQ(store_.list(options).error().param, "text");
    EXPECT_EQ(store_.matching({.text = "?!", .tags = {}}).error().param, "text");
    const std::vector<std::string> tags(kMaxListTags + 1, "t");
    EXPECT_EQ(store_.matching({.text = "", .tags = tags}).error().param, "tags");
}

TEST_F(TextSearch, APageOfAFrequentWordIsReadWithoutReadingAllThatHaveIt) {
    expect(store_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 2000; ++i)
            static_cast<void>(add("c" + std::to_string(i) + "/cat"));
        return {};
    }));
    const auto images = expect(
        store_.list({.limit = 3, .after = ImageId{1500}, .tags = {}, .text = "cat"}));
    ASSERT_EQ(images.size(), 3u);
    EXPECT_EQ(to_int(images.front().id), 1501);
    int steps = 0;
    sqlite3_stmt* statement = nullptr;
    while ((statement = sqlite3_next_stmt(database_.handle(), statement)) != nullptr) {
        if (std::string_view(sqlite3_sql(statement)).find("MATCH ?3") !=
            std::string_view::npos) {
            steps = sqlite3_stmt_status(statement, SQLITE_STMTSTATUS_VM_STEP, 0);
        }
    }
    EXPECT_GT(steps, 0);
    EXPECT_LT(steps, 500);
}

// The index against plain code: words of lower-case letters, compared one by one.
class PlainSearch {
  public:
    struct Row {
        std::string name;
        std::vector<std::string> tags;
        std::vector<std::string> values;
    };

    // One piece of a text: the words in a row, the last one perhaps a prefix.
    struct Piece {
        std::vector<std::string> words;
        bool is_prefix = false;
    };

    static std::vector<std::string> words_of(const std::string& text) {
        std::vector<std::string> words(1);
        for (const char character : text) {
            if (character != ' ') {
                words.back() += character;
            } else {
                words.emplace_back();
            }
        }
        return words;
    }

    static bool has(const std::vector<std::string>& words, const Piece& piece) {
        for (std::size_t at = 0; at + piece.words.size() <= words.size(); ++at) {
            bool same = true;
            for (std::size_t i = 0; i < piece.words.size(); ++i) {
                const bool prefix = piece.is_prefix && i + 1 == piece.words.size();
                same = same && (prefix ? words[at + i].starts_with(piece.words[i])
                                       : words[at + i] == piece.words[i]);
            }
            if (same) return true;
        }
        return false;
    }

    static bool has(const Row& row, const Piece& piece) {
        std::vector<std::string> texts = row.tags;
        texts.insert(texts.end(), row.values.begin(), row.values.end());
        texts.push_back(row.name);
        return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
            return has(words_of(text), piece);
        });
    }
};

class RandomText {
  public:
    explicit RandomText(unsigned seed) : random_(seed) {}

    std::string text(unsigned most_words) {
        std::string text = word();
        for (auto i = random_() % most_words; i > 0; --i) text += ' ' + word();
        return text;
    }
    std::vector<std::string> texts(unsigned most) {
        std::set<std::string> texts;
        for (auto i = random_() % (most + 1); i > 0; --i) texts.insert(text(3));
        return {texts.begin(), texts.end()};
    }
    PlainSearch::Row row(int number) {
        return {"n" + std::to_string(number) + ' ' + text(4), texts(3), texts(3)};
    }
    unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }

  private:
    std::string word() {
        static const std::string words[] = {"cat", "car", "cab", "dog", "do", "sea"};
        return words[random_() % std::size(words)];
    }

    std::mt19937 random_;
};

std::string uri_of(const PlainSearch::Row& row) {
    std::string uri = "x/";
    for (const char character : row.name) {
        uri += character == ' ' ? std::string("%20") : std::string(1, character);
    }
    return uri;
}

std::string metadata_of(const PlainSearch::Row& row) {
    std::string metadata = "{\"list\":[1";
    for (const std::string& value : row.values) metadata += ",\"" + value + '"';
    return metadata + "]}";
}

TEST_F(TextSearch, RandomRowsAndQueriesGiveWhatPlainCodeFinds) {
    run_sql(database_.handle(), "PRAGMA synchronous = OFF");  // nothing crashes here
    RandomText random(11);
    std::map<std::int64_t, PlainSearch::Row> model;
    int hits = 0;
    for (int step = 0; step < 120; ++step) {
        const PlainSearch::Row row = random.row(step);
        const ImageId some{static_cast<std::int64_t>(random.below(60)) + 1};
        const auto known = model.find(to_int(some));
        if (known != model.end() && random.below(3) == 0) {
            expect(store_.remove(some));
            model.erase(known);
        } else if (known != model.end()) {
            expect(store_.describe(
                some,
                {.uri = uri_of(row), .tags = row.tags, .metadata = metadata_of(row)}));
            known->second = row;
        } else {
            NewImage image = upload_picture(step);
            image.uri = uri_of(row);
            image.tags = row.tags;
            image.metadata = metadata_of(row);
            model[to_int(expect(store_.add(image)))] = row;
        }
        if (step % 6 != 0) continue;
        for (int query = 0; query < 8; ++query) {
            std::string text;
            std::vector<PlainSearch::Piece> pieces;
            for (unsigned i = random.below(2) + 1; i > 0; --i) {
                std::string piece = random.text(3);
                const bool is_prefix = random.below(3) == 0;
                if (is_prefix) piece.resize(piece.size() - 1);
                if (piece.ends_with(' ')) piece += 'c';
                pieces.push_back({PlainSearch::words_of(piece), is_prefix});
                text += '"' + piece + '"' + (is_prefix ? "* " : " ");
            }
            std::vector<ImageId> want;
            for (const auto& [id, stored] : model) {
                if (std::all_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
                        return PlainSearch::has(stored, piece);
                    })) {
                    want.push_back(ImageId{id});
                }
            }
            hits += static_cast<int>(want.size());
            EXPECT_EQ(found(text), want) << text;
        }
    }
    EXPECT_GT(hits, 100);
    expect_consistent();
}

}  // namespace
}  // namespace haarmony::schema
