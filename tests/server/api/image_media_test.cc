// Thumbnails and originals.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "ingest/decode.h"
#include "ingest/file_uri.h"
#include "ingest/media_fragment.h"
#include "tests/schema/scratch_folder.h"
#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

class ImageMediaTest : public testing::Test {
  protected:
    ImageMediaTest() : interface_({make_root()}), other_(beside(interface_.collection)) {}

    std::string make_root() {
        fs::create_directories(folder_.file("root"));
        return folder_.file("root");
    }
    // A file with the scene, and its row as ingest would store it.
    std::string add_file(const std::string& name, unsigned number) {
        schema::write_bytes(folder_.file(name), text_of(jpeg_scene(number)));
        const auto id =
            other_->images().add(file_row(number, ingest::file_uri(folder_.file(name))));
        EXPECT_TRUE(id);
        return "/images/" + std::to_string(to_int(id.value())) + "/original";
    }
    static std::string file_bytes(const http::Response& response) {
        const auto& range = std::get<http::FileRange>(response.body);
        return schema::read_bytes(range.path).substr(range.offset, range.length);
    }

    schema::ScratchFolder folder_;
    Interface interface_;
    std::unique_ptr<Connection> other_;
};

TEST_F(ImageMediaTest, AThumbnailIsASmallPicture) {
    interface_.collection.add(1);
    const http::Response response = interface_.get("/images/1/thumbnail");
    ASSERT_EQ(response.status, 200);
    EXPECT_EQ(header_of(response, "Content-Type"), "image/jpeg");
    EXPECT_EQ(header_of(response, "X-Content-Type-Options"), "nosniff");
    const std::string bytes = body_of(response);
    ingest::Decoder decoder{ingest::DecodeLimits{}};
    const auto picture = decoder.decode(
        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 96);
    EXPECT_EQ(picture->height, 64);
}

TEST_F(ImageMediaTest, AThumbnailHonoursRanges) {
    interface_.collection.add(1);
    const std::string whole = body_of(interface_.get("/images/1/thumbnail"));
    const http::Response part =
        interface_.get("/images/1/thumbnail", {{"Range", "bytes=10-19"}});
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(body_of(part), whole.substr(10, 10));
    EXPECT_EQ(interface_.get("/images/1/thumbnail", {{"Range", "bytes=999999-"}}).status,
              416);
}

TEST_F(ImageMediaTest, AnOriginalIsTheFile) {
    const std::string address = add_file("root/a b.jpg", 1);
    const http::Response response = interface_.get(address);
    ASSERT_EQ(response.status, 200) << body_of(response);
    EXPECT_EQ(header_of(response, "Content-Type"), "image/jpeg");
    EXPECT_EQ(file_bytes(response), text_of(jpeg_scene(1)));
    const std::string etag = header_of(response, "ETag");
    EXPECT_EQ(interface_.get(address, {{"If-None-Match", etag}}).status, 304);
    const http::Response part = interface_.get(address, {{"Range", "bytes=-7"}});
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(file_bytes(part), text_of(jpeg_scene(1)).substr(jpeg_scene(1).size() - 7));
}

TEST_F(ImageMediaTest, TheOriginalOfAFrameOfAFilmIsTheFilm) {
    const std::string path = folder_.file("root/film.mkv");
    const std::string film = "\x1a\x45\xdf\xa3 the rest of a film";
    schema::write_bytes(path, film);
    schema::NewImage row =
        file_row(1, ingest::key_frame_uri(ingest::file_uri(path), 40'000));
    row.media_type = "video/x-matroska";
    const auto id = other_->images().add(row);
    ASSERT_TRUE(id);
    const std::string address =
        "/images/" + std::to_string(to_int(id.value())) + "/original";
    const http::Response response = interface_.get(address);
    ASSERT_EQ(response.status, 200) << body_of(response);
    EXPECT_EQ(header_of(response, "Content-Type"), "video/x-matroska");
    EXPECT_EQ(file_bytes(response), film);
    for (const std::string& other :
         {std::string("a secret text"), text_of(jpeg_scene(1))}) {
        schema::write_bytes(path, other);
        EXPECT_EQ(refusal_of(interface_.get(address)), (Refusal{404, "not_found", ""}));
    }
}

TEST_F(ImageMediaTest, AFileOutsideIsForbiddenHoweverItIsReached) {
    const std::string outside = add_file("outside.jpg", 1);
    fs::create_symlink(folder_.file("outside.jpg"), folder_.file("root/link.jpg"));
    const auto linked = other_->images().add(
        file_row(1, ingest::file_uri(folder_.file("root/link.jpg"))));
    ASSERT_TRUE(linked);
    for (const std::string& address :
         {outside, "/images/" + std::to_string(to_int(linked.value())) + "/original"}) {
        const http::Response response = interface_.get(address);
        EXPECT_EQ(refusal_of(response), (Refusal{403, "forbidden", ""}));
        EXPECT_EQ(body_of(response).find(folder_.path()), std::string::npos);
    }
}

TEST_F(ImageMediaTest, AnUploadHasNoOriginal) {
    interface_.collection.add(1);
    interface_.collection.add(1, {"http://example.org/a.jpg", {}, "{}"});
    for (const char* address : {"/images/1/original", "/images/2/original"})
        EXPECT_EQ(refusal_of(interface_.get(address)), (Refusal{404, "not_found", ""}));
}

TEST_F(ImageMediaTest, AFileThatIsGoneOrHasBecomeSomethingElseIsNotFound) {
    const std::string gone = add_file("root/gone.jpg", 1);
    fs::remove(folder_.file("root/gone.jpg"));
    const std::string text = add_file("root/text.jpg", 2);
    schema::write_bytes(folder_.file("root/text.jpg"), "a secret text");
    const std::string png = add_file("root/png.jpg", 3);
    schema::write_bytes(folder_.file("root/png.jpg"),
                        text_of(png_of(image::scene(8, 8, 1).view())));
    const std::string empty = add_file("root/empty.jpg", 4);
    schema::write_bytes(folder_.file("root/empty.jpg"), "");
    for (const std::string& address : {gone, text, png, empty})
        EXPECT_EQ(refusal_of(interface_.get(address)), (Refusal{404, "not_found", ""}))
            << address;
}

}  // namespace
}  // namespace haarmony::server
