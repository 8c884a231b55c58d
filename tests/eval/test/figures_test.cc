// The whole of a small run: its files, and that they are the same every time.
#include "tests/eval/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "ingest/thumbnail.h"
#include "server/app/thread_executor.h"
#include "tests/eval/test/generated_pictures.h"
#include "tests/eval/test/xml_reader.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

using Files = std::map<std::string, std::string>;

Files run(std::uint64_t seed, int threads) {
    server::ThreadExecutor executor(threads - 1);
    FiguresOptions options;
    options.seed = seed;
    options.queries = 2;
    options.m_step = 100;
    options.steps = 2;
    const auto made =
        make_figures(generated_pictures(8), options, executor, [](const std::string&) {});
    EXPECT_TRUE(made);
    Files files;
    for (const OutputFile& file : *made) files[file.name] = file.text;
    return files;
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    if (line.ends_with(',')) result.emplace_back();
    return result;
}

class SmallRun : public ::testing::Test {
  protected:
    static const Files& files() {
        static const Files made = run(1, 2);
        return made;
    }
};

TEST_F(SmallRun, EveryTableHasOneWidthAndFiniteNumbers) {
    int tables = 0;
    for (const auto& [name, text] : files()) {
        if (!name.ends_with(".csv")) continue;
        ++tables;
        EXPECT_EQ(text.find('"'), std::string::npos) << name;  // so that , splits cells
        std::istringstream lines(text);
        std::string line;
        ASSERT_TRUE(std::getline(lines, line));
        const std::vector<std::string> header = cells(line);
        const auto metric = std::ranges::find(header, "metric") - header.begin();
        ASSERT_LT(metric, std::ssize(header)) << name;
        EXPECT_NE(std::ranges::find(header, "resolution"), header.end()) << name;
        int rows = 0;
        while (std::getline(lines, line)) {
            ++rows;
            const std::vector<std::string> row = cells(line);
            ASSERT_EQ(row.size(), header.size()) << name << ": " << line;
            for (const std::string& cell : row) {
                EXPECT_TRUE(cell != "nan" && cell != "-nan" && cell != "inf" &&
                            cell != "-inf")
                    << name << ": " << line;
            }
            const std::string& named = row[metric];
            EXPECT_TRUE(named == "L^q" || named == "L1" || named == "L2" ||
                        named == "histogram")
                << name << ": " << named;
        }
        EXPECT_GT(rows, 0) << name;
    }
    EXPECT_EQ(tables, 9);
}

TEST_F(SmallRun, ThePageIsWellFormedAndNeedsNothingFromElsewhere) {
    const std::string& html = files().at("index.html");
    const XmlReading page = read_xml(html.substr(html.find('\n') + 1));
    EXPECT_EQ(page.error, "");
    EXPECT_GE(page.elements.at("svg"), 20);
    EXPECT_EQ(page.elements.count("script"), 0U);
    EXPECT_EQ(page.elements.count("link"), 0U);
    EXPECT_EQ(page.elements.count("img"), 0U);
    EXPECT_EQ(page.attributes.count("src"), 0U);
    for (const std::string& target : page.attributes.at("href"))
        EXPECT_TRUE(target.starts_with('#')) << target;
    EXPECT_EQ(html.find("http"), std::string::npos);
    EXPECT_EQ(html.find("url("), std::string::npos);
    EXPECT_EQ(html.find("@import"), std::string::npos);
    // It ends with what wins.
    EXPECT_GT(html.rfind("id=\"winners\""), html.rfind("id=\"table-4-2\""));
}

TEST_F(SmallRun, ThreadsChangeNothingButTheTimes) {
    const Files again = run(1, 1);
    for (const auto& [name, text] : files()) {
        if (name == "index.html" || name == "table_4_2.csv") continue;
        EXPECT_EQ(text, again.at(name)) << name;
    }
}

TEST(MakeFigures, NeedsTwoPictures) {
    InlineExecutor executor;
    const auto ignore = [](const std::string&) {};
    const auto none = make_figures(generated_pictures(0), {}, executor, ignore);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
    const auto one = make_figures(generated_pictures(1), {}, executor, ignore);
    ASSERT_FALSE(one);
    EXPECT_EQ(one.error().code, ErrorCode::kInvalidArgument);
}

TEST(WriteFiles, MakesTheFolderAndKeepsTheBytes) {
    const testing::TemporaryFolder folder;
    ASSERT_TRUE(
        write_files({{"a.csv", "x,y\n"}, {"b.html", "<p/>"}}, folder.file("new")));
    std::ifstream file(folder.file("new") + "/a.csv", std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "x,y\n");
}

TEST(WriteFiles, NamesWhatCannotBeWritten) {
    const testing::TemporaryFolder folder;
    std::ofstream(folder.file("taken")) << "a file";
    const auto below_a_file = write_files({{"a.csv", ""}}, folder.file("taken"));
    ASSERT_FALSE(below_a_file);
    EXPECT_EQ(below_a_file.error().code, ErrorCode::kIo);
    EXPECT_NE(below_a_file.error().message.find("taken"), std::string::npos);
    const auto missing_folder =
        write_files({{"none/a.csv", "x"}}, folder.path().string());
    ASSERT_FALSE(missing_folder);
    EXPECT_NE(missing_folder.error().message.find("none/a.csv"), std::string::npos);
}

TEST(FolderSource, ReadsPicturesInTheOrderOfTheirPaths) {
    const testing::TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("b"));
    for (const char* name : {"c.jpg", "b/x.jpg", "a.jpg"}) {
        const auto jpeg = ingest::encode_jpeg(gradient(40, 30).view(), 90);
        ASSERT_TRUE(jpeg);
        std::ofstream file(folder.file(name), std::ios::binary);
        file.write(reinterpret_cast<const char*>(jpeg->data()),
                   static_cast<std::streamsize>(jpeg->size()));
    }
    std::ofstream(folder.file("d.jpg")) << "no picture";
    const auto source = folder_source(folder.path().string());
    ASSERT_TRUE(source);
    EXPECT_EQ(source->names,
              (std::vector<std::string>{"a.jpg", "b/x.jpg", "c.jpg", "d.jpg"}));
    const auto picture = source->load(1);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 40);
    EXPECT_EQ(picture->height, 30);
    const auto torn = source->load(3);
    ASSERT_FALSE(torn);
    EXPECT_NE(torn.error().message.find("d.jpg"), std::string::npos);
    std::filesystem::remove(folder.file("c.jpg"));
    const auto gone = source->load(2);
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().code, ErrorCode::kIo);
}

TEST(FolderSource, NamesAFolderThatIsNotThere) {
    const testing::TemporaryFolder folder;
    const auto source = folder_source(folder.file("missing"));
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
    EXPECT_NE(source.error().message.find("missing"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::eval
