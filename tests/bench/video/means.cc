#include "tests/bench/video/means.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "engine/video/create_frame.h"
#include "engine/video/exact_mean.h"
#include "engine/video/picture.h"
#include "tests/bench/video/by_turns.h"

namespace haarmony::video::bench {
namespace {

constexpr int kFrames = 16;

enum class Kind { kOpaque, kAlpha };

// A slow sweep of shades under noise of a few grey levels: no two pixels of it stay equal.
std::vector<Picture> clip(const MeansOptions& options, Kind kind) {
    std::mt19937 random(7);
    std::vector<Picture> frames;
    for (int t = 0; t < kFrames; ++t) {
        Picture& frame = frames.emplace_back(options.width, options.height);
        for (int y = 0; y < frame.height; ++y) {
            for (int x = 0; x < frame.width; ++x) {
                const auto bits = static_cast<std::uint32_t>(random());
                const auto shade = [&](double phase, int shift) {
                    const double wave = 120 + 100 * std::sin(0.01 * (x + t) + phase * y);
                    return static_cast<std::uint8_t>(wave + (bits >> shift & 7));
                };
                const int alpha =
                    kind == Kind::kOpaque ? 255 : static_cast<int>(bits >> 24);
                frame.at(x, y) = {shade(0.01, 0),
                                  shade(0.02, 3),
                                  shade(0.03, 6),
                                  static_cast<std::uint8_t>(alpha)};
            }
        }
    }
    return frames;
}

// The plain way: one sum for each pixel of each level of the root square, and a division for
// each of its channels.
class PlainMean {
  public:
    PlainMean(int width, int height)
        : levels_(std::bit_width(static_cast<unsigned>(std::max(width, height) - 1))) {
        for (int level = 0; level <= levels_; ++level) {
            sums_.emplace_back(std::size_t{1} << 2 * level);
            means_.emplace_back(std::size_t{1} << 2 * level);
        }
    }

    void add(const Picture& picture) {
        std::vector<PixelSum>& finest = sums_.back();
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                finest[static_cast<std::size_t>((y << levels_) + x)] +=
                    sum_of(picture.at(x, y), 1);
            }
        }
        ++frames_;
    }

    void average() {
        for (int level = levels_; level >= 0; --level) {
            const auto at = static_cast<std::size_t>(level);
            const std::uint64_t samples = frames_ << 2 * (levels_ - level);
            for (int i = 0; i < 1 << 2 * level; ++i) {
                const int x = i & ((1 << level) - 1), y = i >> level;
                if (level < levels_)
                    sums_[at][static_cast<std::size_t>(i)] = four(at, x, y);
                means_[at][static_cast<std::size_t>(i)] =
                    mean(sums_[at][static_cast<std::size_t>(i)], samples);
            }
        }
    }

    [[nodiscard]] Rgba root() const { return means_[0][0]; }

  private:
    [[nodiscard]] PixelSum four(std::size_t level, int x, int y) const {
        const std::vector<PixelSum>& finer = sums_[level + 1];
        PixelSum sum;
        for (int q = 0; q < 4; ++q) {
            const int row = 2 * y + (q >> 1), column = 2 * x + (q & 1);
            sum += finer[static_cast<std::size_t>((row << (level + 1)) + column)];
        }
        return sum;
    }

    int levels_;
    std::uint64_t frames_ = 0;
    std::vector<std::vector<PixelSum>> sums_;
    std::vector<std::vector<Rgba>> means_;
};

// Every time node of the clip, as build() makes them: the leaf, and each node whose last
// frame this is.
class Pass {
  public:
    explicit Pass(const FrameFormat& format) {
        for (int frames = 1; frames <= kFrames; frames *= 2) sums_.emplace_back(format);
    }

    void run(const std::vector<Picture>& frames) {
        for (FrameSum& sum : sums_) sum.clear();
        for (std::size_t t = 0; t < frames.size(); ++t) {
            create_frame(frames[t].view(), tree_);
            sums_[0].add(tree_, 1);
            sums_[0].mean_into(out_);
            for (std::size_t k = 0; k + 1 < sums_.size(); ++k) {
                sums_[k + 1].add(sums_[k]);
                sums_[k].clear();
                if ((t + 1) % (std::size_t{2} << k) != 0) break;
                sums_[k + 1].mean_into(out_);
            }
        }
    }

  private:
    std::vector<FrameSum> sums_;
    ImageTree tree_;
    ExactFrame out_;
};

bool measure(const MeansOptions& options, Kind kind, const std::string& name) {
    const FrameFormat format{options.width, options.height, {}};
    const std::vector<Picture> frames = clip(options, kind);
    std::vector<ImageTree> trees(kFrames);
    for (std::size_t t = 0; t < kFrames; ++t) create_frame(frames[t].view(), trees[t]);
    FrameSum one(format), all(format), odd(format), sum(format);
    one.add(trees[0], 1);
    for (const ImageTree& tree : trees) all.add(tree, 1);
    for (std::size_t t = 0; t < kFrames - 1; ++t) odd.add(trees[t], 1);

    ImageTree tree;
    ExactFrame out;
    PlainMean plain(options.width, options.height);
    Pass pass(format);
    const auto each = [](const std::function<void(std::size_t)>& work) {
        return [work] {
            for (std::size_t t = 0; t < kFrames; ++t) work(t);
        };
    };
    const std::string size = "/" + std::to_string(options.width * options.height);
    measure_by_turns(
        {
            {"video/plain-mean-" + name + size, each([&](std::size_t t) {
                 plain.add(frames[t]);
                 plain.average();
             })},
            {"video/create-" + name + size,
             each([&](std::size_t t) { create_frame(frames[t].view(), tree); })},
            {"video/add-frame-" + name + size, each([&](std::size_t t) {
                 if (t == 0) sum.clear();
                 sum.add(trees[t], 1);
             })},
            {"video/add-sum-" + name + size, each([&](std::size_t t) {
                 if (t == 0) sum.clear();
                 sum.add(all);
             })},
            {"video/mean-of-1-" + name + size,
             each([&](std::size_t) { one.mean_into(out); })},
            {"video/mean-of-15-" + name + size,
             each([&](std::size_t) { odd.mean_into(out); })},
            {"video/mean-of-16-" + name + size,
             each([&](std::size_t) { all.mean_into(out); })},
            {"video/all-means-" + name + size, [&] { pass.run(frames); }},
        },
        std::int64_t{kFrames} * options.width * options.height,
        options.rounds);
    // The plain way has added all frames as often as there were rounds: the same mean.
    all.mean_into(out);
    return out.apex[static_cast<std::size_t>(Edge::kPad)][0] == plain.root();
}

}  // namespace

bool measure_means(const MeansOptions& options) {
    print_head("source pixel", "plain mean");
    const bool opaque = measure(options, Kind::kOpaque, "opaque");
    const bool alpha = measure(options, Kind::kAlpha, "alpha");
    return opaque && alpha;
}

}  // namespace haarmony::video::bench
