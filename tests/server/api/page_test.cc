#include "server/page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "server/embedded.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

class PageTest : public testing::Test {
  protected:
    // A page in `folder` that says `text`.
    std::string make_page(const std::string& folder, const std::string& text) {
        fs::create_directories(folder_.file(folder));
        schema::write_bytes(folder_.file(folder + "/index.html"), text);
        return folder_.file(folder);
    }
    static std::string served(const http::StaticFiles& page) {
        http::Request request;
        request.method = "GET";
        request.path = "/";
        const http::Response response = page(request);
        if (const auto* range = std::get_if<http::FileRange>(&response.body))
            return schema::read_bytes(range->path);
        return std::get<std::string>(response.body);
    }
    [[nodiscard]] std::string served_by(const std::optional<std::string>& web) const {
        const auto page = open_page(web, folder_.file("bin/haarmonyd"));
        EXPECT_TRUE(page);
        return page ? served(page.value()) : "";
    }
    static std::string built_in() {
        for (const http::EmbeddedFile& file : embedded_web())
            if (file.path == "index.html") return std::string(file.content);
        return "";
    }

    schema::ScratchFolder folder_;
};

TEST_F(PageTest, IsBuiltInWhereThereIsNoOther) {
    EXPECT_NE(built_in(), "");
    EXPECT_EQ(served_by({}), built_in());
}

TEST_F(PageTest, TheInstallPrefixGoesBeforeWhatIsBuiltIn) {
    fs::create_directories(folder_.file("bin"));
    make_page("share/haarmony/web", "installed");
    EXPECT_EQ(served_by({}), "installed");
    make_page("bin/web", "beside");
    EXPECT_EQ(served_by({}), "beside");
    EXPECT_EQ(served_by(make_page("elsewhere", "named")), "named");
}

TEST_F(PageTest, AFolderThatIsNoneIsNamed) {
    const std::string gone = folder_.file("gone");
    const auto page = open_page(gone, folder_.file("bin/haarmonyd"));
    ASSERT_FALSE(page);
    EXPECT_EQ(page.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(page.error().message.find(gone), std::string::npos);
}

TEST_F(PageTest, EveryFileOfThePageIsBuiltInByteByByte) {
    ASSERT_FALSE(embedded_web().empty());
    for (const http::EmbeddedFile& file : embedded_web())
        EXPECT_EQ(
            file.content,
            schema::read_bytes(std::string(HAARMONY_WEB) + "/" + std::string(file.path)))
            << file.path;
}

}  // namespace
}  // namespace haarmony::server
