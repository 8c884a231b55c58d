#include "server/app/media_roots.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "ingest/file_uri.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

class MediaRootsTest : public testing::Test {
  protected:
    MediaRootsTest() {
        fs::create_directories(folder_.file("pictures/deep"));
        fs::create_directories(folder_.file("pictures-not"));
        schema::write_bytes(folder_.file("pictures/a b.jpg"), "a");
        schema::write_bytes(folder_.file("pictures/deep/c.jpg"), "c");
        schema::write_bytes(folder_.file("pictures-not/secret.jpg"), "s");
        schema::write_bytes(folder_.file("secret.jpg"), "s");
        fs::create_symlink(folder_.file("secret.jpg"),
                           folder_.file("pictures/escape.jpg"));
        fs::create_symlink(folder_.path(), folder_.file("pictures/up"));
        fs::create_symlink("a b.jpg", folder_.file("pictures/inside.jpg"));
        real_ = fs::canonical(folder_.path());
    }

    [[nodiscard]] MediaRoots roots() const {
        const std::vector<std::string> folders{folder_.file("pictures")};
        auto opened = MediaRoots::open(folders);
        EXPECT_TRUE(opened);
        return std::move(opened).value();
    }
    [[nodiscard]] Result<std::string> locate(const std::string& name) const {
        return roots().locate(ingest::file_uri(folder_.path() + "/" + name));
    }
    void expect_refused(const Result<std::string>& result, ErrorCode code) const {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, code);
        EXPECT_EQ(result.error().message.find(folder_.path()), std::string::npos)
            << result.error().message;
    }

    schema::ScratchFolder folder_;
    fs::path real_;
};

TEST_F(MediaRootsTest, FindsFilesBelowARoot) {
    const auto spaced = locate("pictures/a b.jpg");
    ASSERT_TRUE(spaced);
    EXPECT_EQ(spaced.value(), (real_ / "pictures/a b.jpg").string());
    const auto deep = locate("pictures/deep/c.jpg");
    ASSERT_TRUE(deep);
    EXPECT_EQ(deep.value(), (real_ / "pictures/deep/c.jpg").string());
}

TEST_F(MediaRootsTest, FollowsLinksThatStayInside) {
    const auto inside = locate("pictures/inside.jpg");
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside.value(), (real_ / "pictures/a b.jpg").string());
}

TEST_F(MediaRootsTest, RefusesWhatLeadsOutside) {
    for (const std::string name : {"secret.jpg",
                                   "pictures/../secret.jpg",
                                   "pictures/escape.jpg",
                                   "pictures/up/secret.jpg",
                                   "pictures/up/gone.jpg",
                                   "gone.jpg",
                                   "pictures-not/secret.jpg",
                                   "pictures-not/gone.jpg"}) {
        SCOPED_TRACE(name);
        expect_refused(locate(name), ErrorCode::kForbidden);
    }
}

TEST_F(MediaRootsTest, AFileThatIsGoneOrNoFileIsNotFound) {
    expect_refused(locate("pictures/gone.jpg"), ErrorCode::kNotFound);
    expect_refused(locate("pictures/deep"), ErrorCode::kNotFound);
}

TEST_F(MediaRootsTest, AnAddressOfNoFileOfThisMachineIsNotFound) {
    for (const std::string uri : {"",
                                  "http://example.org/a.jpg",
                                  "file://elsewhere/a.jpg",
                                  "file:///a%2",
                                  "file:///a%00b"}) {
        SCOPED_TRACE(uri);
        expect_refused(roots().locate(uri), ErrorCode::kNotFound);
    }
}

TEST_F(MediaRootsTest, APathLeadsToWhatLiesBelowARoot) {
    const MediaRoots media = roots();
    const auto real = [&](const std::string& name) {
        return media.locate_path(folder_.file(name));
    };
    EXPECT_EQ(real("pictures").value(), (real_ / "pictures").string());
    EXPECT_EQ(real("pictures/deep/../inside.jpg").value(),
              (real_ / "pictures/a b.jpg").string());
    for (const char* name : {"",
                             "secret.jpg",
                             "pictures-not",
                             "pictures/../secret.jpg",
                             "pictures/escape.jpg",
                             "pictures/up",
                             "gone"})
        EXPECT_EQ(real(name).error().code, ErrorCode::kForbidden) << name;
    EXPECT_EQ(real("pictures/gone").error().code, ErrorCode::kNotFound);
    for (const std::string& path : {std::string(),
                                    std::string("pictures"),
                                    folder_.file("pictures") + std::string(1, '\0')})
        EXPECT_EQ(media.locate_path(path).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(MediaRootsTest, WithoutRootsEveryFileIsForbidden) {
    const auto none = MediaRoots::open({});
    ASSERT_TRUE(none);
    expect_refused(none->locate(ingest::file_uri(folder_.file("pictures/a b.jpg"))),
                   ErrorCode::kForbidden);
}

TEST_F(MediaRootsTest, ARootMustBeAFolderAndIsNamed) {
    for (const std::string name : {"gone", "secret.jpg"}) {
        const std::vector<std::string> folders{folder_.file(name)};
        const auto refused = MediaRoots::open(folders);
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(refused.error().message.find(folder_.file(name)), std::string::npos);
    }
}

}  // namespace
}  // namespace haarmony::server
