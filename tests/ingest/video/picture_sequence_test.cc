#include "ingest/picture_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ingest/png_chunks.h"
#include "ingest/thumbnail.h"
#include "tests/ingest/scratch_folder.h"
#include "tests/ingest/video/clips.h"

namespace haarmony::ingest {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void write(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

Result<Shown> read_files(const std::vector<std::string>& files,
                         video::FrameRate rate = {25, 1}) {
    PictureSequenceOptions options;
    options.files = files;
    options.rate = rate;
    return read_all(open_picture_sequence(options));
}

TEST(PictureSequence, IsAClipInTheOrderOfItsFiles) {
    const ScratchFolder folder;
    const Clip clip = moving_clip({20, 15, {24, 1}}, 3, Alpha::kRandom);
    std::vector<std::string> files;
    for (std::size_t i = 0; i < 3; ++i) {
        files.push_back(folder / (std::to_string(i) + ".png"));
        write(files.back(), png_file(clip.pictures[i].view()).value());
    }
    const auto shown = read_files(files, {24, 1});
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, clip.format);
    EXPECT_EQ(shown->pictures, clip.pictures);
    EXPECT_THAT(shown->times_us, ElementsAre(0, 41'666, 83'333));
}

TEST(PictureSequence, JpegsKeepTheirSize) {
    const ScratchFolder folder;
    const Clip clip = moving_clip({800, 600, {25, 1}}, 1, Alpha::kOpaque);
    write(folder / "a.jpg", encode_jpeg(clip.pictures[0].view(), 95).value());
    const auto shown = read_files({folder / "a.jpg"});
    ASSERT_TRUE(shown) << shown.error().message;
    EXPECT_EQ(shown->format, clip.format);
    EXPECT_GT(psnr(shown->pictures, clip.pictures), 35);
}

TEST(PictureSequence, ErrorsNameTheFileAndNotItsFolder) {
    const ScratchFolder folder;
    const auto png = [](int width) {
        return png_file(video::Picture(width, 8).view()).value();
    };
    write(folder / "8.png", png(8));
    write(folder / "9.png", png(9));
    write(folder / "bad.png", {1, 2, 3});
    const auto error = [&folder](const char* first, const char* second) {
        const auto shown = read_files({folder / first, folder / second});
        EXPECT_FALSE(shown);
        return shown ? Error{} : shown.error();
    };
    const Error other = error("8.png", "9.png");
    EXPECT_EQ(other.code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(other.message, "9.png is 9 x 8 pixels, the pictures before are 8 x 8");
    EXPECT_THAT(error("bad.png", "8.png").message, HasSubstr("bad.png: unknown format"));
    const Error later = error("8.png", "bad.png");
    EXPECT_EQ(later.code, ErrorCode::kUnsupportedFormat);
    EXPECT_EQ(error("8.png", "none.png").code, ErrorCode::kNotFound);

    EXPECT_EQ(read_files({}).error().code, ErrorCode::kInvalidArgument);
    const auto backwards = read_files({folder / "8.png"}, {-25, 1});
    ASSERT_FALSE(backwards);
    EXPECT_EQ(backwards.error().param, "rate");
    PictureSequenceOptions small;
    small.files = {folder / "8.png"};
    small.max_file_bytes = 10;
    EXPECT_EQ(read_all(open_picture_sequence(small)).error().code, ErrorCode::kTooLarge);
}

TEST(PicturesIn, CountsNumbersAsNumbers) {
    const ScratchFolder folder;
    for (const char* name : {"b1.png",
                             "a10.png",
                             "a9.PNG",
                             "a010.png",
                             "a.jpg",
                             "notes.txt",
                             "a9-2.png",
                             "a00.webp"}) {
        write(folder / name, {});
    }
    std::filesystem::create_directory(folder / "a11.png");
    const auto files = pictures_in(folder.path());
    ASSERT_TRUE(files) << files.error().message;
    std::vector<std::string> names;
    for (const std::string& file : *files) {
        EXPECT_TRUE(std::filesystem::exists(file));
        names.push_back(std::filesystem::path(file).filename());
    }
    EXPECT_THAT(
        names,
        ElementsAre(
            "a.jpg", "a00.webp", "a9-2.png", "a9.PNG", "a010.png", "a10.png", "b1.png"));
    EXPECT_EQ(pictures_in(folder / "none").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace haarmony::ingest
