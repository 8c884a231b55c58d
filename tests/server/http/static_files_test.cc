#include "server/http/static_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/http/scratch_folder.h"

namespace haarmony::http {
namespace {

namespace fs = std::filesystem;

Response get(const StaticFiles& files, std::string path) {
    Request request;
    request.method = "GET";
    request.path = std::move(path);
    return files(request);
}

std::string text_of(const Response& response) {
    return std::get<std::string>(response.body);
}

class StaticFolder : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_.write("web/index.html", "<p>page</p>");
        folder_.write("web/js/canvas.js", "export {};");
        folder_.write("web/.hidden", "secret");
        folder_.write("web/.git/config", "secret");
        folder_.write("outside.txt", "secret");
    }
    [[nodiscard]] StaticFiles files() const {
        auto opened = StaticFiles::open(folder_.path() / "web");
        EXPECT_TRUE(opened);
        return *std::move(opened);
    }

    test::ScratchFolder folder_;
};

TEST_F(StaticFolder, RootIsTheIndex) {
    const Response response = get(files(), "/");
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(text_of(response), "<p>page</p>");
    EXPECT_EQ(response.headers.at("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(text_of(get(files(), "/index.html")), "<p>page</p>");
}

TEST_F(StaticFolder, FilesInFoldersHaveTheirMediaType) {
    const Response response = get(files(), "/js/canvas.js");
    EXPECT_EQ(text_of(response), "export {};");
    EXPECT_EQ(response.headers.at("Content-Type"), "text/javascript; charset=utf-8");
}

TEST_F(StaticFolder, EveryFileCarriesTheSecurityHeaders) {
    const Response response = get(files(), "/");
    EXPECT_THAT(response.headers.at("Content-Security-Policy"),
                ::testing::StartsWith("default-src 'self'; img-src 'self' blob: data:"));
    EXPECT_EQ(response.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(response.headers.at("Cache-Control"), "no-cache");
}

TEST_F(StaticFolder, NothingElseIsServed) {
    fs::create_symlink(folder_.path() / "outside.txt", folder_.path() / "web/link.txt");
    fs::create_symlink(folder_.path(), folder_.path() / "web/up");
    fs::create_symlink(folder_.path() / "web/nowhere", folder_.path() / "web/broken");
    ASSERT_EQ(::mkfifo((folder_.path() / "web/pipe").c_str(), 0600), 0);
    for (const char* path : {"/none",
                             "/js",
                             "/js/",
                             "//index.html",
                             "/js//canvas.js",
                             "/index.html/",
                             "/index.html/x",
                             "/.hidden",
                             "/.git/config",
                             "/../outside.txt",
                             "/js/../../outside.txt",
                             "/js/../index.html",
                             "/./index.html",
                             "/..\\outside.txt",
                             "/link.txt",
                             "/up/outside.txt",
                             "/broken",
                             "/pipe",
                             "index.html",
                             ""}) {
        const Response response = get(files(), path);
        EXPECT_EQ(response.status, 404) << path;
        EXPECT_EQ(nlohmann::json::parse(text_of(response))["code"], "not_found");
    }
    EXPECT_EQ(get(files(), std::string("/index.html\0.png", 16)).status, 404);
}

TEST_F(StaticFolder, LinksThatStayInsideAreFollowed) {
    fs::create_symlink("index.html", folder_.path() / "web/start.html");
    EXPECT_EQ(text_of(get(files(), "/start.html")), "<p>page</p>");
}

TEST_F(StaticFolder, FolderBesideWithTheSamePrefixIsOutside) {
    folder_.write("web-secret/x.txt", "secret");
    fs::create_symlink(folder_.path() / "web-secret", folder_.path() / "web/beside");
    EXPECT_EQ(get(files(), "/beside/x.txt").status, 404);
}

TEST_F(StaticFolder, TagChangesWithTheContentOnly) {
    const StaticFiles served = files();
    const std::string before = get(served, "/").headers.at("ETag");
    EXPECT_EQ(get(served, "/").headers.at("ETag"), before);
    folder_.write("web/index.html", "<p>Page</p>");
    const std::string after = get(served, "/").headers.at("ETag");
    EXPECT_NE(after, before);
    folder_.write("web/index.html", "<p>page</p>");
    EXPECT_EQ(get(served, "/").headers.at("ETag"), before);
}

TEST_F(StaticFolder, LargeFilesAreStreamedWithRanges) {
    const std::string path = folder_.write("web/big.wasm", std::string(kHashed + 1, 'x'));
    const StaticFiles served = files();
    const Response response = get(served, "/big.wasm");
    EXPECT_EQ(response.headers.at("Content-Type"), "application/wasm");
    EXPECT_EQ(response.headers.at("Accept-Ranges"), "bytes");
    const auto& range = std::get<FileRange>(response.body);
    EXPECT_EQ(range.path, fs::canonical(path));
    EXPECT_EQ(range.length, kHashed + 1);
    const std::string before = response.headers.at("ETag");
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(1));
    EXPECT_NE(get(served, "/big.wasm").headers.at("ETag"), before);
}

TEST_F(StaticFolder, MissingFolderIsAnErrorThatNamesIt) {
    const auto missing = StaticFiles::open(folder_.path() / "none");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
    EXPECT_THAT(missing.error().message, ::testing::HasSubstr("none"));
    EXPECT_FALSE(StaticFiles::open(folder_.path() / "outside.txt"));
}

TEST(StaticEmbedded, ServesItsFilesAndNothingElse) {
    static constexpr std::array<EmbeddedFile, 2> kFiles{
        {{"index.html", "<p>built in</p>"}, {"css/a.css", "p{}"}}};
    const StaticFiles files{kFiles};
    EXPECT_EQ(text_of(get(files, "/")), "<p>built in</p>");
    const Response css = get(files, "/css/a.css");
    EXPECT_EQ(text_of(css), "p{}");
    EXPECT_EQ(css.headers.at("Content-Type"), "text/css; charset=utf-8");
    EXPECT_NE(css.headers.at("ETag"), get(files, "/").headers.at("ETag"));
    EXPECT_EQ(get(files, "/css").status, 404);
    EXPECT_EQ(get(files, "/css/b.css").status, 404);
}

TEST(MediaType, IsKnownByTheExtensionWithoutCase) {
    EXPECT_EQ(media_type_of("a.b.PNG"), "image/png");
    EXPECT_EQ(media_type_of("x/y.mjs"), "text/javascript; charset=utf-8");
    EXPECT_EQ(media_type_of("png"), "application/octet-stream");
    EXPECT_EQ(media_type_of("a.unknown"), "application/octet-stream");
}

}  // namespace
}  // namespace haarmony::http
