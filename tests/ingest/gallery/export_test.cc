#include "ingest/gallery/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <thread>

#include "ingest/decode.h"
#include "ingest/gallery/gallery.h"

namespace haarmony::gallery {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Export : public testing::Test {
  protected:
    Export() {
        std::string pattern = (fs::temp_directory_path() / "gallery-XXXXXX").string();
        root_ = ::mkdtemp(pattern.data());
    }
    ~Export() override { fs::remove_all(root_); }

    [[nodiscard]] ExportOptions options(int count) const {
        return {.folder = root_ / "a" / "b",
                .seed = 1,
                .count = count,
                .jobs = 2,
                .side = 40};
    }
    // Name to content.
    [[nodiscard]] std::map<std::string, std::string> files(const fs::path& folder) const {
        std::map<std::string, std::string> found;
        for (const auto& entry : fs::directory_iterator(folder)) {
            std::ifstream file(entry.path(), std::ios::binary);
            found[entry.path().filename().string()] =
                std::string(std::istreambuf_iterator<char>(file), {});
        }
        return found;
    }

    fs::path root_;
};

TEST_F(Export, WritesOneNamedJpegAPicture) {
    const auto report = export_gallery(options(3));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->written, 3);
    EXPECT_EQ(report->unchanged, 0);
    const auto written = files(options(3).folder);
    ASSERT_EQ(written.size(), 3U);
    for (int number = 0; number < 3; ++number) {
        const auto found =
            written.find(file_name(paint(1, number, kLeastSide).kind, number));
        ASSERT_NE(found, written.end()) << number;
        EXPECT_EQ(found->second.substr(0, 3), "\xFF\xD8\xFF");
        EXPECT_EQ(found->second.substr(found->second.size() - 2), "\xFF\xD9");
    }
}

TEST_F(Export, PicturesHaveTheSideThatIsAskedForOrTheGallerys) {
    ExportOptions gallery = options(1);
    gallery.folder = root_ / "gallery";
    gallery.side.reset();
    ASSERT_TRUE(export_gallery(options(1)));
    ASSERT_TRUE(export_gallery(gallery));
    const auto longest_side = [&](const fs::path& folder) {
        const std::string jpeg = files(folder).begin()->second;
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(jpeg.data()),
                              jpeg.size());
        const auto picture = ingest::Decoder({}).decode(bytes);
        return picture ? std::max(picture->width, picture->height) : 0;
    };
    EXPECT_EQ(longest_side(options(1).folder), 40);
    EXPECT_EQ(longest_side(gallery.folder), gallery_side(1, 0));
}

TEST_F(Export, NamesCountFromOneAndHaveNoBlanks) {
    EXPECT_EQ(file_name("landscape", 0), "landscape-001.jpg");
    EXPECT_EQ(file_name("still life", 41), "still-life-042.jpg");
    EXPECT_EQ(file_name("flag", 12344), "flag-12345.jpg");
}

TEST_F(Export, FilesThatAreThereAlreadyKeepTheirTime) {
    ASSERT_TRUE(export_gallery(options(2)));
    std::map<fs::path, fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator(options(2).folder)) {
        fs::last_write_time(entry.path(), fs::file_time_type{});
        times[entry.path()] = fs::last_write_time(entry.path());
    }
    const auto report = export_gallery(options(3));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->written, 1);
    EXPECT_EQ(report->unchanged, 2);
    for (const auto& [path, time] : times)
        EXPECT_EQ(fs::last_write_time(path), time) << path;
}

TEST_F(Export, DamagedFilesAreMadeWhole) {
    ASSERT_TRUE(export_gallery(options(2)));
    const auto before = files(options(2).folder);
    auto path = before.begin();
    // One of another length, one of the same length.
    std::ofstream(options(2).folder / path->first, std::ios::trunc) << "half a pic";
    ++path;
    std::string damaged = path->second;
    damaged[damaged.size() / 2] ^= 1;
    std::ofstream(options(2).folder / path->first, std::ios::binary) << damaged;

    const auto report = export_gallery(options(2));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->written, 2);
    EXPECT_EQ(files(options(2).folder), before);
}

TEST_F(Export, TheNumberOfJobsChangesNothing) {
    ExportOptions one = options(4);
    one.jobs = 1;
    ExportOptions many = options(4);
    many.folder = root_ / "many";
    many.jobs = 8;
    ASSERT_TRUE(export_gallery(one));
    ASSERT_TRUE(export_gallery(many));
    EXPECT_EQ(files(one.folder), files(many.folder));
}

TEST_F(Export, TwoExportsIntoOneFolderTakeTurns) {
    Result<ExportReport> other = ExportReport{};
    std::thread thread([&] { other = export_gallery(options(3)); });
    const auto report = export_gallery(options(3));
    thread.join();
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(report->written + other->written, 3) << "each picture is written once";
    EXPECT_EQ(files(options(3).folder).size(), 3U);
}

TEST_F(Export, AFileInTheFoldersPlaceIsNamed) {
    std::ofstream(root_ / "a") << "not a folder";
    const auto report = export_gallery(options(1));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kIo);
    EXPECT_THAT(report.error().message, HasSubstr((root_ / "a").string()));
}

TEST_F(Export, AFolderInAPicturesPlaceIsNamedAndNothingIsLeftBehind) {
    const std::string name = file_name(paint(1, 0, kLeastSide).kind, 0);
    const fs::path blocked = options(1).folder / name;
    fs::create_directories(blocked / "full");
    const auto report = export_gallery(options(1));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kIo);
    EXPECT_THAT(report.error().message, HasSubstr(blocked.string()));
    EXPECT_FALSE(fs::exists(options(1).folder / ("." + name + ".part")));
}

TEST_F(Export, AFolderInTheTemporaryFilesPlaceIsNamed) {
    const std::string name = file_name(paint(1, 0, kLeastSide).kind, 0);
    const fs::path part = options(1).folder / ("." + name + ".part");
    fs::create_directories(part);
    const auto report = export_gallery(options(1));
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, HasSubstr(part.string()));
}

// While it lives, files of this process end at `bytes`, as on a full disk.
class FileLimit {
  public:
    explicit FileLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit tight{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &tight);
    }
    ~FileLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, SIG_DFL);
    }
    FileLimit(const FileLimit&) = delete;
    FileLimit& operator=(const FileLimit&) = delete;

  private:
    rlimit before_{};
};

TEST_F(Export, APictureThatDoesNotFitOnTheDiskLeavesNothingBehind) {
    const FileLimit limit(256);
    const auto report = export_gallery(options(2));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kIo);
    EXPECT_THAT(report.error().message, HasSubstr("cannot write"));
    EXPECT_TRUE(fs::is_empty(options(2).folder));
}

}  // namespace
}  // namespace haarmony::gallery
