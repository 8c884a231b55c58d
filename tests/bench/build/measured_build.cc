#include "tests/bench/build/measured_build.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "engine/core/image_view.h"
#include "engine/video/build.h"
#include "engine/video/create_frame.h"

namespace haarmony::video::bench {
namespace {

class RawFrames final : public FrameSource {
  public:
    RawFrames(const FrameFormat& format, std::span<const std::uint8_t> frames)
        : format_(format), frames_(frames) {}

    [[nodiscard]] const FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(SourceFrame& frame) override {
        const double begin = thread_seconds();
        const auto row = std::ptrdiff_t{4} * format_.width;
        const auto bytes = static_cast<std::size_t>(row * format_.height);
        if (frames_.size() < bytes) return false;
        create_frame(ImageView{frames_.data(), format_.width, format_.height, 4, row},
                     frame.tree);
        frame.repeats = 1;
        frames_ = frames_.subspan(bytes);
        seconds_ += thread_seconds() - begin;
        return true;
    }
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    FrameFormat format_;
    std::span<const std::uint8_t> frames_;
    double seconds_ = 0;
};

// A clip in memory, and when the first of it came.
class TimedSink final : public ClipSink {
  public:
    [[nodiscard]] Result<void> begin(const ClipShape& shape,
                                     std::uint32_t delta) override {
        begun_ = thread_seconds();
        return clip_.begin(shape, delta);
    }
    [[nodiscard]] Result<void> add(Siblings siblings) override {
        return clip_.add(std::move(siblings));
    }
    [[nodiscard]] Result<void> finish() override { return clip_.finish(); }
    [[nodiscard]] double begun() const { return begun_; }
    [[nodiscard]] std::unique_ptr<MemoryClip> take() { return clip_.take(); }

  private:
    MemoryClip::Sink clip_;
    double begun_ = 0;
};

[[noreturn]] void fail(const Error& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    std::exit(1);
}

}  // namespace

double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

Result<std::uint64_t> WarmSpool::append(std::span<const std::byte> bytes) {
    const std::size_t offset = used_;
    if (bytes_.size() < used_ + bytes.size()) bytes_.resize(2 * (used_ + bytes.size()));
    if (!bytes.empty()) std::memcpy(bytes_.data() + offset, bytes.data(), bytes.size());
    used_ += bytes.size();
    return offset;
}

Result<void> WarmSpool::read(std::uint64_t offset, std::span<std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
    return {};
}

MeasuredBuild measured_build(const FrameFormat& format,
                             std::span<const std::uint8_t> frames,
                             std::uint32_t delta,
                             WarmSpool& spool) {
    MeasuredBuild measured;
    RawFrames source(format, frames);
    TimedSink sink;
    BuildOptions options;
    options.delta = delta;
    spool.clear();
    const double begin = thread_seconds();
    const Result<ClipShape> shape = build(source, spool, sink, options);
    const double built = thread_seconds();
    if (!shape) fail(shape.error());
    measured.clip = sink.take();
    const Result<StorageCounts> counts = count_storage(*measured.clip);
    measured.accounting = thread_seconds() - built;
    if (!counts) fail(counts.error());
    measured.counts = *counts;
    measured.pass_1 = sink.begun() - begin - source.seconds();
    measured.pass_2 = built - sink.begun();
    return measured;
}

}  // namespace haarmony::video::bench
