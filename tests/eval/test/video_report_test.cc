// The whole of a small run, its tables, and what counts as a miss.
#include "tests/eval/video_report.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/eval/test/video_frames.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

using haarmony::testing::TemporaryFolder;

Result<VideoReport> small_run(const std::string& folder, std::string* heard = nullptr) {
    VideoOptions options;
    options.clips = folder;
    options.frames = 3;
    options.side = 16;
    options.deltas = {4, 16};
    options.speed.questions = 2;
    options.speed.rounds = 1;
    options.speed.build_frames = 2;
    return measure_video(options, [&](const std::string& line) {
        if (heard != nullptr) *heard += line + ' ';
    });
}

class SmallVideoRun : public ::testing::Test {
  protected:
    static const VideoReport& report() {
        static const VideoReport made = [] {
            const TemporaryFolder folder;
            write_file(folder.file("a.png"), apng_of(noisy_clip(24, 16, 5)));
            std::string heard;
            auto run = small_run(folder.path(), &heard);
            EXPECT_TRUE(run.has_value()) << run.error().message;
            EXPECT_EQ(heard, "a.png julia galaxy fluid wind room panorama clip-art ");
            return *std::move(run);
        }();
        return made;
    }
};

TEST_F(SmallVideoRun, EveryClipHasItsSizes) {
    ASSERT_EQ(report().sizes.size(), 8U);
    EXPECT_EQ(report().sizes.front().kind, VideoKind::kNatural);
    EXPECT_EQ(report().sizes.back().kind, VideoKind::kClipArt);
    for (const VideoSizes& size : report().sizes) {
        EXPECT_EQ(size.frames, 3) << size.name;
        EXPECT_EQ(size.raw,
                  std::uint64_t{4} * 3 * static_cast<std::uint64_t>(size.width) *
                      static_cast<std::uint64_t>(size.height));
        for (const std::uint64_t bytes : {size.paper,
                                          size.memory,
                                          size.file,
                                          size.ffv1,
                                          size.x264_lossless,
                                          size.x264_intra}) {
            EXPECT_GT(bytes, 0U) << size.name;
        }
    }
}

TEST_F(SmallVideoRun, OnlyTheFoldersClipsHaveBoundsAndAllHold) {
    ASSERT_EQ(report().bounds.size(), 2U);
    for (const VideoBound& bound : report().bounds) {
        EXPECT_EQ(bound.name, "a.png");
        EXPECT_TRUE(bound.held()) << bound.delta;
        EXPECT_GT(bound.worst_leaf, 0) << bound.delta;
    }
    EXPECT_EQ(report().broken_bounds(), 0);
}

TEST_F(SmallVideoRun, EverythingIsTimedOnce) {
    std::set<std::string> rows;
    for (const VideoSpeed& row : report().speed) {
        EXPECT_GT(row.pixels_a_second, 0) << row.what;
        EXPECT_GT(row.ratio.median, 0) << row.what;
        EXPECT_TRUE(rows.insert(row.name + ' ' + row.what + ' ' + row.beside).second);
    }
    EXPECT_EQ(rows.size(), 2U * 10);
    EXPECT_TRUE(rows.contains("a.png video/blur-3 libav, default groups"));
    EXPECT_TRUE(rows.contains("clip-art video/root single frame"));
}

TEST_F(SmallVideoRun, TablesHaveOneWidthAndARowForEach) {
    const std::vector<OutputFile> files = video_files(report());
    ASSERT_EQ(files.size(), 3U);
    const std::vector<std::size_t> rows = {
        report().sizes.size(), report().bounds.size(), report().speed.size()};
    for (std::size_t f = 0; f < files.size(); ++f) {
        std::istringstream lines(files[f].text);
        std::size_t count = 0;
        for (std::string line; std::getline(lines, line); ++count) {
            EXPECT_EQ(line.find("nan"), std::string::npos) << files[f].name;
            EXPECT_EQ(line.find("inf"), std::string::npos) << files[f].name;
        }
        EXPECT_EQ(count, rows[f] + 1) << files[f].name;
    }
}

TEST(VideoReport, AFolderWithoutClipsOrWithADamagedOneIsAnError) {
    const TemporaryFolder folder;
    EXPECT_EQ(small_run(folder.path()).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(small_run(folder.file("nowhere")).error().code, ErrorCode::kNotFound);
    const std::string bytes = apng_of(noisy_clip(40, 40, 3));
    write_file(folder.file("cut.png"), bytes.substr(0, bytes.size() / 2));
    EXPECT_EQ(small_run(folder.path()).error().code, ErrorCode::kUndecodable);
}

// A report in which every target is exactly met.
VideoReport met() {
    VideoReport report;
    VideoSizes natural;
    natural.name = "walk";
    natural.raw = 1000;
    natural.memory = 2200;
    natural.ffv1 = 100;
    natural.file = 300;
    VideoSizes art = natural;
    art.name = "art";
    art.kind = VideoKind::kClipArt;
    art.memory = 150;
    art.file = 15;
    VideoSizes generated = natural;
    generated.name = "wind";
    generated.kind = VideoKind::kGenerated;
    generated.memory = 9000;
    generated.file = 9000;
    report.sizes = {natural, art, generated};
    report.bounds = {{"walk", 4, 4, 3.5, 1}};
    VideoSpeed draw;
    draw.name = "walk";
    draw.what = "video/draw-full";
    draw.pixels_a_second = 1e9;
    draw.least_pixels_a_second = 1e9;
    VideoSpeed jump = draw;
    jump.what = "video/jump-quarter";
    jump.beside = "libav";
    jump.least_pixels_a_second.reset();
    jump.ratio.median = 10;
    jump.least_ratio = 10;
    VideoSpeed free = draw;
    free.pixels_a_second = 1;
    free.least_pixels_a_second.reset();
    report.speed = {draw, jump, free};
    return report;
}

TEST(VideoReport, WhatReachesItsTargetIsNoMiss) {
    EXPECT_TRUE(met().misses().empty());
    EXPECT_NE(to_text(met()).find("all targets met"), std::string::npos);
    EXPECT_FALSE(met().speed.back().has_target());
}

TEST(VideoReport, EveryMissIsNamedWithWhatWasReached) {
    VideoReport report = met();
    report.sizes[0].memory = 2500;
    report.sizes[0].file = 301;
    report.sizes[1].memory = 160;
    report.bounds[0].worst_coarse = 4.5;
    report.speed[0].pixels_a_second = 0.9e9;
    report.speed[1].ratio.median = 9;
    EXPECT_EQ(report.broken_bounds(), 1);
    EXPECT_FALSE(report.speed[0].met());
    EXPECT_EQ(report.misses(),
              (std::vector<std::string>{
                  "walk: memory / raw 2.5, target 2.2",
                  "walk: mrv / FFV1 3.01, target 3",
                  "art: memory / raw 0.16, target 0.15",
                  "walk: difference at delta 4 4.5, target 4",
                  "walk: video/draw-full Mpixel/s 900, target 1000",
                  "walk: video/jump-quarter beside libav x 9, target 10"}));
}

}  // namespace
}  // namespace haarmony::eval
