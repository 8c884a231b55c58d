#include "tests/eval/video_speed.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <utility>

#include "engine/video/display.h"
#include "engine/video/mrv_clip.h"
#include "tests/eval/video_decoder.h"
#include "tests/eval/video_encoder.h"
#include "tests/eval/video_sizes.h"

namespace haarmony::eval {
namespace {

constexpr double kDrawTarget = 1e9;
constexpr double kBuildTarget = 20e6;
constexpr double kIntraTarget = 10;
constexpr double kInterTarget = 100;
constexpr double kBlurTarget = 500;
// A leaf's time / the root's: the root may take 1.2 times as long.
constexpr double kRootTarget = 1 / 1.2;
constexpr int kBlurLevels = 6;  // 64 frames

class ClipSpeed {
  public:
    ClipSpeed(const VideoClip& clip, const VideoSpeedOptions& options)
        : clip_(clip), options_(options) {}

    Result<std::vector<VideoSpeed>> run();

  private:
    Error named(const Error& error) const {
        return {error.code, clip_.name + ": " + error.message, error.param};
    }
    // The first error of what is timed; the times then mean nothing.
    template <typename T>
    void note(const Result<T>& result) {
        if (!result && error_.message.empty()) error_ = result.error();
    }
    [[nodiscard]] video::PixelBox whole(int level) const {
        return {0, 0, shape_->width_at(level), shape_->height_at(level)};
    }
    void draw(const video::TimeTree& tree, const video::NodeAddress& at, int level);
    // Theirs beside ours; `pixels` are ours of one question.
    void add(const std::string& what,
             const std::string& beside,
             int questions,
             double pixels,
             const std::function<void(std::size_t)>& theirs,
             const std::function<void(std::size_t)>& ours);
    [[nodiscard]] VideoSpeed& last() { return rows_.back(); }

    Result<void> measure_build();
    void measure_drawing();
    void measure_root();
    Result<void> measure_jumps();
    Result<void> measure_cold(const EncodedFilm& intra);
    Result<std::unique_ptr<FilmDecoder>> decoder_of(const EncodedFilm& film, int level);
    void decode(FilmDecoder& decoder, std::int64_t first, std::int64_t count) {
        note(decoder.frames(first, count, [this](const video::Picture& picture) {
            seen_ = picture.pixels.back().g;
        }));
    }

    const VideoClip& clip_;
    const VideoSpeedOptions& options_;
    std::unique_ptr<video::MemoryClip> built_;
    const video::ClipShape* shape_ = nullptr;
    std::vector<std::int64_t> frames_;  // by question
    video::Picture drawn_;
    std::vector<VideoSpeed> rows_;
    Error error_{ErrorCode::kIo, {}, {}};
    // Volatile: what is not used need not be computed.
    volatile std::uint8_t seen_ = 0;
};

void ClipSpeed::draw(const video::TimeTree& tree,
                     const video::NodeAddress& at,
                     int level) {
    const auto frame = tree.frame(at, level);
    note(frame);
    if (!frame) return;
    video::draw(*frame,
                level,
                video::Edge::kNormalize,
                whole(level),
                drawn_.pixels.data(),
                shape_->width_at(level));
    seen_ = drawn_.pixels.front().g;
}

void ClipSpeed::add(const std::string& what,
                    const std::string& beside,
                    int questions,
                    double pixels,
                    const std::function<void(std::size_t)>& theirs,
                    const std::function<void(std::size_t)>& ours) {
    const PairedTimes times =
        measure_in_turn(static_cast<std::size_t>(questions), 1, theirs, ours);
    VideoSpeed row;
    row.name = clip_.name;
    row.what = "video/" + what;
    row.beside = beside;
    row.pixels_a_second = pixels / (times.second.median_ms * 1e-3);
    row.ratio = times.ratio;
    rows_.push_back(std::move(row));
}

Result<void> ClipSpeed::measure_build() {
    VideoClip part{clip_.name, clip_.kind, clip_.format, clip_.frames};
    part.frames.resize(std::min(part.frames.size(), options_.build_frames));
    const double pixels = static_cast<double>(part.raw_bytes()) / sizeof(video::Rgba);
    const auto ffv1 = [&](std::size_t) {
        note(encode_film(part.frames, VideoEncoding::kFfv1));
    };
    add("build-memory", "ffv1", options_.rounds, pixels, ffv1, [&](std::size_t) {
        note(built_in_memory(part, 0));
    });
    last().least_pixels_a_second = kBuildTarget;
    add("build-mrv", "ffv1", options_.rounds, pixels, ffv1, [&](std::size_t) {
        std::uint64_t bytes = 0;
        note(built_as_file(part, bytes));
    });
    last().least_pixels_a_second = kBuildTarget;
    return error_.message.empty() ? Result<void>() : error_;
}

void ClipSpeed::measure_drawing() {
    constexpr std::array<const char*, 3> kNames = {
        "draw-full", "draw-half", "draw-quarter"};
    const int finest = shape_->space_levels();
    for (int coarser = 0; coarser < 3 && finest - coarser >= 0; ++coarser) {
        const int level = finest - coarser;
        std::vector<video::Picture> ready;
        for (std::int64_t i = 0; i < shape_->frames(); ++i) {
            const auto frame = built_->frame({shape_->time_levels(), i}, level);
            note(frame);
            if (!frame) return;
            ready.push_back(video::draw(*frame, level, video::Edge::kNormalize));
        }
        const video::PixelBox box = whole(level);
        add(
            kNames[static_cast<std::size_t>(coarser)],
            "memcpy",
            options_.questions,
            static_cast<double>(box.width) * box.height,
            [&](std::size_t q) {
                const auto& pixels = ready[static_cast<std::size_t>(frames_[q])].pixels;
                std::memcpy(drawn_.pixels.data(),
                            pixels.data(),
                            pixels.size() * sizeof(video::Rgba));
                seen_ = drawn_.pixels.front().g;
            },
            [&](std::size_t q) {
                draw(*built_, {shape_->time_levels(), frames_[q]}, level);
            });
        if (coarser < 2) last().least_pixels_a_second = kDrawTarget;
    }
}

void ClipSpeed::measure_root() {
    const int level = shape_->space_levels();
    const video::PixelBox box = whole(level);
    add(
        "root",
        "single frame",
        options_.questions,
        static_cast<double>(box.width) * box.height,
        [&](std::size_t) {
            draw(*built_, {shape_->time_levels(), 0}, level);
        },
        [&](std::size_t) {
            draw(*built_, {0, 0}, level);
        });
    last().least_ratio = kRootTarget;
}

Result<std::unique_ptr<FilmDecoder>> ClipSpeed::decoder_of(const EncodedFilm& film,
                                                           int level) {
    auto decoder =
        FilmDecoder::open(film, shape_->width_at(level), shape_->height_at(level));
    if (!decoder) return named(decoder.error());
    return decoder;
}

Result<void> ClipSpeed::measure_jumps() {
    const int level = std::max(shape_->space_levels() - 2, 0);
    const double pixels =
        static_cast<double>(shape_->width_at(level)) * shape_->height_at(level);
    const auto ours = [&](std::size_t q) {
        draw(*built_, {shape_->time_levels(), frames_[q]}, level);
    };
    const auto intra = encode_film(clip_.frames, VideoEncoding::kIntra);
    if (!intra) return named(intra.error());
    const auto inter = encode_film(clip_.frames, VideoEncoding::kInter);
    if (!inter) return named(inter.error());
    auto keys = decoder_of(*intra, level);
    if (!keys) return keys.error();
    add(
        "jump-quarter",
        "libav, key frames only",
        options_.questions,
        pixels,
        [&](std::size_t q) { decode(**keys, frames_[q], 1); },
        ours);
    last().least_ratio = kIntraTarget;
    auto groups = decoder_of(*inter, level);
    if (!groups) return groups.error();
    add(
        "jump-quarter",
        "libav, default groups",
        options_.questions,
        pixels,
        [&](std::size_t q) { decode(**groups, frames_[q], 1); },
        ours);
    last().least_ratio = kInterTarget;

    const int k = std::max(shape_->time_levels() - kBlurLevels, 0);
    const video::FrameRange range = shape_->frames_of({k, 0});
    add(
        "blur-" + std::to_string(range.count()),
        "libav, default groups",
        options_.rounds,
        pixels,
        [&](std::size_t) { decode(**groups, range.first, range.count()); },
        [&](std::size_t) {
            draw(*built_, {k, 0}, level);
        });
    if (range.count() == std::int64_t{1} << kBlurLevels) last().least_ratio = kBlurTarget;
    if (!error_.message.empty()) return named(error_);
    return measure_cold(*intra);
}

Result<void> ClipSpeed::measure_cold(const EncodedFilm& intra) {
    std::uint64_t file_bytes = 0;
    const auto spool = built_as_file(clip_, file_bytes);
    if (!spool) return spool.error();
    std::vector<std::byte> file(file_bytes);
    if (const auto read = (*spool)->read(0, file); !read) return named(read.error());
    const auto opened = video::MrvClip::open(file, 0);
    if (!opened) return named(opened.error());
    const int level = shape_->space_levels();
    auto decoder = decoder_of(intra, level);
    if (!decoder) return decoder.error();
    const video::PixelBox box = whole(level);
    add(
        "cold-mrv",
        "libav, key frames only",
        options_.questions,
        static_cast<double>(box.width) * box.height,
        [&](std::size_t q) { decode(**decoder, frames_[q], 1); },
        [&](std::size_t q) {
            draw(**opened, {shape_->time_levels(), frames_[q]}, level);
        });
    draw(*built_, {shape_->time_levels(), frames_[0]}, level);
    const std::vector<video::Rgba> expected = drawn_.pixels;
    draw(**opened, {shape_->time_levels(), frames_[0]}, level);
    if (drawn_.pixels != expected) {
        return Error{ErrorCode::kConflict, clip_.name + ": the file shows other pixels"};
    }
    return {};
}

Result<std::vector<VideoSpeed>> ClipSpeed::run() {
    if (const auto measured = measure_build(); !measured) return named(measured.error());
    auto built = built_in_memory(clip_, 0);
    if (!built) return built.error();
    built_ = *std::move(built);
    shape_ = &built_->shape();
    drawn_ = video::Picture(shape_->width(), shape_->height());
    std::mt19937 random(7);
    for (int q = 0; q < options_.questions; ++q) {
        frames_.push_back(static_cast<std::int64_t>(random()) % shape_->frames());
    }
    measure_drawing();
    measure_root();
    if (const auto measured = measure_jumps(); !measured) return measured.error();
    if (!error_.message.empty()) return named(error_);
    return std::move(rows_);
}

}  // namespace

Result<std::vector<VideoSpeed>> measure_video_speed(const VideoClip& clip,
                                                    const VideoSpeedOptions& options) {
    assert(!clip.frames.empty() && options.questions >= 1 && options.rounds >= 1 &&
           options.build_frames >= 1);
    return ClipSpeed(clip, options).run();
}

}  // namespace haarmony::eval
