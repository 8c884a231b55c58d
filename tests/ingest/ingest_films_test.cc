// The real haarmony-ingest on real films: which rows it leaves, and that a film is recorded
// whole or not at all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/image/signature.h"
#include "engine/image/signature_codec.h"
#include "ingest/describe.h"
#include "ingest/file_uri.h"
#include "ingest/media_fragment.h"
#include "ingest/video_sink.h"
#include "ingest/video_source.h"
#include "schema/database.h"
#include "tests/ingest/ingest_fixture.h"

namespace haarmony::ingest {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int kSide = 48;

video::Picture frame_of(int scene, int frame) {
    video::Picture picture(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            picture.at(x, y) = {static_cast<std::uint8_t>(5 * ((x + frame) % kSide)),
                                static_cast<std::uint8_t>(5 * y),
                                static_cast<std::uint8_t>(60 * scene),
                                255};
    return picture;
}

// One frame a second: the encoder makes every second one a key frame, or more.
std::string film_of(int scene, int frames, Container container) {
    std::string bytes;
    VideoSinkOptions options;
    options.container = container;
    options.format = {kSide, kSide, {1, 1}};
    options.frames = frames;
    auto sink =
        open_video_sink(options, [&](std::span<const std::uint8_t> part) -> Result<void> {
            bytes.append(part.begin(), part.end());
            return {};
        });
    EXPECT_TRUE(sink) << sink.error().message;
    for (int i = 0; i < frames; ++i) EXPECT_TRUE((*sink)->add(frame_of(scene, i).view()));
    EXPECT_TRUE((*sink)->finish());
    return bytes;
}

// What the decoder shows of a film, by the address that a frame has.
std::map<std::string, video::Picture> shown(const std::string& path, VideoFrames frames) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    VideoSourceOptions options;
    options.frames = frames;
    const auto source = open_video(std::move(file), options);
    EXPECT_TRUE(source) << source.error().message;
    std::map<std::string, video::Picture> pictures;
    TimedPicture picture;
    for (int left = 1'000; left > 0; --left) {
        const auto more = (*source)->next(picture);
        EXPECT_TRUE(more);
        if (!more || !*more) break;
        pictures.emplace(key_frame_uri(file_uri(path), picture.time_us), picture.picture);
    }
    return pictures;
}

std::string hash_of(const std::string& text) {
    return content_hash(
        {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

class IngestFilms : public IngestFixture {
  protected:
    std::map<std::string, schema::Image> images() const {
        std::map<std::string, schema::Image> images;
        auto database =
            schema::Database::open(database_, schema::Database::Mode::kReadOnly);
        if (!database) return images;
        schema::ImageStore store(*database);
        const auto listed = store.list({.limit = 1'000, .after = {}, .tags = {}});
        EXPECT_TRUE(listed);
        for (const schema::Image& image : *listed) images[image.uri] = image;
        return images;
    }
    std::vector<std::uint8_t> signature(ImageId id) const {
        auto database =
            schema::Database::open(database_, schema::Database::Mode::kReadOnly);
        return schema::ImageStore(*database).signature(id).value();
    }
    Finished ingest_films(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"--videos", "--progress", "none", pictures_};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ingest(arguments);
    }
};

TEST_F(IngestFilms, EveryKeyFrameIsAPictureThatTellsItsPlaceInTheFilm) {
    const std::string bytes = film_of(1, 9, Container::kMp4);
    const std::string path = folder_.write("pictures/a film.mp4", bytes);
    folder_.write("pictures/b.webm", film_of(2, 3, Container::kWebm));
    folder_.write("pictures/c.jpg", jpeg_of(1, 32, 32));
    const Finished finished = ingest_films();
    ASSERT_EQ(finished.status, 0) << finished.err;
    const auto all = shown(path, VideoFrames::kAll);
    const auto keys = shown(path, VideoFrames::kKey);
    ASSERT_EQ(all.size(), 9u);
    ASSERT_GE(keys.size(), 4u);
    const std::string film = file_uri(path);
    std::size_t found = 0;
    for (const auto& [uri, image] : images()) {
        if (without_fragment(uri) != film) continue;
        ++found;
        ASSERT_TRUE(all.contains(uri)) << uri;
        EXPECT_TRUE(keys.contains(uri)) << uri;
        EXPECT_EQ(signature(image.id),
                  image::encode_signature(image::make_signature(all.at(uri).view())));
        EXPECT_EQ(image.width, kSide);
        EXPECT_EQ(image.media_type, "video/mp4");
        EXPECT_EQ(image.stamp.content_hash,
                  hash_of(hash_of(bytes) + uri.substr(film.size())));
        const json metadata = json::parse(image.metadata);
        EXPECT_EQ(metadata["video"], film);
        EXPECT_EQ(key_frame_uri(
                      film, 1'000 * std::llround(1'000 * metadata["time"].get<double>())),
                  uri);
        EXPECT_EQ(metadata["frame"], metadata["time"]) << "one frame a second";
    }
    EXPECT_EQ(found, keys.size());
    const std::size_t rows = images().size();
    EXPECT_EQ(counts_of(finished.out),
              "seen=3 added=" + std::to_string(rows) +
                  " updated=0 skipped=0 failed=0 pruned=0");
    EXPECT_EQ(counts_of(ingest_films().out),
              "seen=3 added=0 updated=0 skipped=3 failed=0 pruned=0");
}

TEST_F(IngestFilms, NoMoreKeyFramesThanAskedFor) {
    folder_.write("pictures/a.mp4", film_of(1, 9, Container::kMp4));
    const Finished finished = ingest_films({"--max-key-frames", "2"});
    EXPECT_EQ(finished.status, 0) << finished.err;
    const auto kept = images();
    ASSERT_GE(kept.size(), 1u);
    EXPECT_LE(kept.size(), 2u);
    EXPECT_THAT(kept.begin()->first, HasSubstr("#t=0.000"));
}

TEST_F(IngestFilms, ADamagedFilmAndWhatIsNoneAreFailuresWithReasons) {
    const std::string whole = film_of(1, 9, Container::kMp4);
    const std::string path =
        folder_.write("pictures/cut.mp4", whole.substr(0, whole.size() / 8));
    const std::string text = folder_.write("pictures/text.mkv", "no film at all");
    const Finished finished = ingest_films();
    EXPECT_EQ(finished.status, 1);
    EXPECT_EQ(counts_of(finished.out),
              "seen=2 added=0 updated=0 skipped=0 failed=2 pruned=0");
    EXPECT_THAT(finished.err, HasSubstr("failed: " + path + ": damaged MP4 video: "));
    EXPECT_THAT(finished.err, HasSubstr("failed: " + text + ": "));
}

TEST_F(IngestFilms, AChangedFilmIsRecordedAnew) {
    const std::string path =
        folder_.write("pictures/a.mp4", film_of(1, 9, Container::kMp4));
    ASSERT_EQ(ingest_films().status, 0);
    const auto before = images();
    folder_.write("pictures/a.mp4", film_of(3, 3, Container::kMp4), kLongAgoNs + 1);
    const Finished finished = ingest_films();
    const auto now = images();
    EXPECT_EQ(now.size(), shown(path, VideoFrames::kKey).size());
    const std::string first = file_uri(path) + "#t=0.000";
    EXPECT_EQ(now.at(first).id, before.at(first).id);
    EXPECT_EQ(signature(now.at(first).id),
              image::encode_signature(image::make_signature(
                  shown(path, VideoFrames::kAll).at(first).view())));
    EXPECT_THAT(finished.out,
                HasSubstr(" pruned=" + std::to_string(before.size() - now.size()) + ' '));
}

// The first file is a bad one, whose line waits for a reader: the run stands still.
TEST_F(IngestFilms, KilledBeforeItsTurnAFilmHasNoRowAndTheNextRunHasItWhole) {
    folder_.write("pictures/0.jpg", "no picture");
    const std::string path =
        folder_.write("pictures/a.mp4", film_of(1, 9, Container::kMp4));
    ChildProcess child(
        command({"--videos", "--jobs", "1", "--progress", "none", pictures_}),
        {.full_errors = true});
    child.signal(SIGKILL);
    ASSERT_EQ(child.wait(), -SIGKILL);
    const std::size_t whole = shown(path, VideoFrames::kKey).size();
    const std::size_t kept = images().size();
    EXPECT_TRUE(kept == 0 || kept == whole) << kept;
    EXPECT_EQ(ingest_films().status, 1);
    EXPECT_EQ(images().size(), whole);
}

}  // namespace
}  // namespace haarmony::ingest
