// Films: exported, and read again as uploads and as files of the server.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tests/engine/video/plain_clip.h"
#include "tests/server/api/interface.h"
#include "tests/server/app/job_watch.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using video::testing::random_clip;
using video::testing::RawClip;

class VideoFilmTest : public testing::Test {
  protected:
    VideoFilmTest() : interface_({media_.path()}) {}

    schema::Job ended(const http::Response& queued) {
        EXPECT_EQ(queued.status, 202) << body_of(queued);
        if (queued.status != 202) return {};
        return finished(*interface_.jobs, json_of(queued)["id"].get<std::int64_t>());
    }
    std::string made(const http::Response& queued) {
        const schema::Job job = ended(queued);
        EXPECT_EQ(job.state, schema::JobState::kDone)
            << (job.errors.empty() ? "" : job.errors.front());
        const json shown = json_of(interface_.get("/jobs/" + std::to_string(job.id)));
        return shown.contains("video") ? shown["video"].dump() : "0";
    }
    std::string upload(const RawClip& clip) {
        std::string bytes;
        for (const video::Picture& frame : clip.frames)
            bytes.append(reinterpret_cast<const char*>(frame.pixels.data()),
                         4 * frame.pixels.size());
        return made(
            interface_.post("/videos?rate=10&width=" + std::to_string(clip.format.width) +
                                "&height=" + std::to_string(clip.format.height),
                            "application/octet-stream",
                            bytes));
    }
    // All that a stream gives.
    std::string film(const std::string& video, const std::string& options) {
        http::Response response =
            interface_.get("/videos/" + video + "/export?" + options);
        EXPECT_EQ(response.status, 200) << body_of(response);
        const auto* source = std::get_if<http::ChunkSource>(&response.body);
        if (source == nullptr) return "";
        std::string bytes;
        while (const auto chunk = (*source)()) bytes += *chunk;
        return bytes;
    }
    std::string revision(const std::string& video) {
        return json_of(interface_.get("/videos/" + video))["revision"];
    }
    Refusal refused(const json& request) {
        return refusal_of(interface_.post_json("/videos", request));
    }

    schema::ScratchFolder media_;
    Interface interface_;
};

TEST_F(VideoFilmTest, AnExportWithoutLossComesBackAsTheSameVideo) {
    const std::string video = upload(random_clip(12, 9, 4, 1));
    const std::string apng = film(video, "format=apng");
    ASSERT_TRUE(apng.starts_with("\x89PNG"));
    EXPECT_EQ(revision(made(interface_.post("/videos", "image/apng", apng))),
              revision(video));
    schema::write_bytes(media_.file("clip.png"), apng);
    EXPECT_EQ(revision(made(
                  interface_.post_json("/videos", {{"path", media_.file("clip.png")}}))),
              revision(video));
}

TEST_F(VideoFilmTest, AnExportIsOfOneTimeLevelAndOneSpaceLevel) {
    const std::string video = upload(random_clip(16, 8, 4, 2));
    const std::string half = made(interface_.post(
        "/videos", "image/apng", film(video, "format=apng&time_level=1&level=3")));
    const json shown = json_of(interface_.get("/videos/" + half));
    EXPECT_EQ(shown["frames"], 2);
    EXPECT_EQ(shown["width"], 8);
    EXPECT_EQ(shown["height"], 4);
    EXPECT_DOUBLE_EQ(shown["rate"].get<double>(), 5.0);
    const auto frame = [&](const std::string& place) {
        return body_of(interface_.get("/video/frame?format=rgba&" + place));
    };
    EXPECT_EQ(frame("frame=1&video=" + half),
              frame("time_level=1&index=1&level=3&video=" + video));
}

TEST_F(VideoFilmTest, PicturesInAZipAreNumbered) {
    const std::string video = upload(random_clip(5, 4, 2, 3));
    const std::string zip = film(video, "format=png-zip");
    EXPECT_TRUE(zip.starts_with("PK"));
    EXPECT_NE(zip.find("000000.png"), std::string::npos);
    EXPECT_NE(zip.find("000001.png"), std::string::npos);
}

TEST_F(VideoFilmTest, OfWhatIsNotThereIsRefused) {
    const std::string video = upload(random_clip(5, 4, 2, 4));
    const auto refusal = [&](const std::string& options) {
        return refusal_of(interface_.get("/videos/" + video + "/export?" + options));
    };
    EXPECT_EQ(refusal("format=avi"), (Refusal{400, "invalid_argument", "format"}));
    EXPECT_EQ(refusal("format=mrv&level=1"), (Refusal{400, "invalid_argument", "level"}));
    EXPECT_EQ(refusal("format=apng&level=4"), (Refusal{422, "out_of_range", "level"}));
    EXPECT_EQ(refusal("format=apng&time_level=-1"),
              (Refusal{422, "out_of_range", "time_level"}));
    EXPECT_EQ(interface_.get("/videos/77/export?format=apng").status, 404);
    EXPECT_EQ(interface_.get("/videos/77/export").status, 404);
}

TEST_F(VideoFilmTest, AFolderOfNumberedPicturesIsAClip) {
    const RawClip clip = random_clip(6, 6, 3, 5);
    std::filesystem::create_directory(media_.file("shots"));
    for (std::size_t i = 0; i < clip.frames.size(); ++i)
        schema::write_bytes(media_.file("shots/" + std::to_string(i + 9) + ".png"),
                            text_of(png_of(clip.frames[i].view())));
    const std::string video =
        made(interface_.post_json("/videos", {{"path", media_.file("shots")}}));
    const json shown = json_of(interface_.get("/videos/" + video));
    EXPECT_EQ(shown["frames"], 3);
    const std::string last =
        body_of(interface_.get("/video/frame?format=rgba&frame=2&video=" + video));
    EXPECT_EQ(last,
              std::string(reinterpret_cast<const char*>(clip.frames[2].pixels.data()),
                          4 * clip.frames[2].pixels.size()));
    // One that leads out of the media roots.
    const schema::ScratchFolder elsewhere;
    schema::write_bytes(elsewhere.file("x.png"), text_of(png_of(clip.frames[0].view())));
    std::filesystem::create_symlink(elsewhere.file("x.png"), media_.file("shots/1.png"));
    const schema::Job job =
        ended(interface_.post_json("/videos", {{"path", media_.file("shots")}}));
    EXPECT_EQ(job.state, schema::JobState::kFailed);
    ASSERT_EQ(job.errors.size(), 1u);
    EXPECT_EQ(job.errors[0].find(elsewhere.path()), std::string::npos);
}

TEST_F(VideoFilmTest, AClipFileOfTheServerIsCopied) {
    const std::string video = upload(random_clip(6, 6, 2, 6));
    const auto file = interface_.get("/videos/" + video + "/export");
    const std::string bytes =
        schema::read_bytes(std::get<http::FileRange>(file.body).path);
    schema::write_bytes(media_.file("clip.mrv"), bytes);
    EXPECT_EQ(revision(made(
                  interface_.post_json("/videos", {{"path", media_.file("clip.mrv")}}))),
              revision(video));
    EXPECT_EQ(schema::read_bytes(media_.file("clip.mrv")), bytes);
}

TEST_F(VideoFilmTest, PathsAndBytesThatAreNoFilmAreRefusedBeforeThereIsAJob) {
    const schema::ScratchFolder elsewhere;
    EXPECT_EQ(refused({{"path", elsewhere.path()}}), (Refusal{403, "forbidden", "path"}));
    EXPECT_EQ(refused({{"path", media_.path() + "/../x"}}),
              (Refusal{403, "forbidden", "path"}));
    EXPECT_EQ(refused({{"path", media_.file("gone")}}),
              (Refusal{404, "not_found", "path"}));
    EXPECT_EQ(refused({{"path", "relative"}}),
              (Refusal{400, "invalid_argument", "path"}));
    EXPECT_EQ(refused({{"path", 1}}), (Refusal{400, "invalid_argument", "path"}));
    EXPECT_EQ(refused({{"path", media_.path()}, {"generate", "julia"}}).code,
              "several_sources");
    schema::write_bytes(media_.file("text"), "no film at all");
    EXPECT_EQ(refused({{"path", media_.file("text")}}).status, 415);
    const http::Response pdf = interface_.post("/videos", "video/mp4", "%PDF-1.7 x");
    EXPECT_EQ(refusal_of(pdf), (Refusal{415, "unsupported_format", "Content-Type"}));
    EXPECT_NE(json_of(pdf)["detail"].get<std::string>().find("PDF"), std::string::npos);
    EXPECT_EQ(json_of(interface_.get("/jobs"))["items"], json::array());
}

TEST_F(VideoFilmTest, AFilmThatIsCutOffFailsItsJobAndLeavesNothing) {
    const std::string video = upload(random_clip(32, 32, 4, 7));
    const std::string apng = film(video, "format=apng");
    const schema::Job job =
        ended(interface_.post("/videos", "image/apng", apng.substr(0, 60)));
    EXPECT_EQ(job.state, schema::JobState::kFailed);
    EXPECT_FALSE(job.errors.empty());
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(interface_.videos->files().folder())) {
        EXPECT_EQ(entry.path().extension(), ".mrv") << entry.path();
        ++files;
    }
    EXPECT_EQ(files, 1u);
}

}  // namespace
}  // namespace haarmony::server
