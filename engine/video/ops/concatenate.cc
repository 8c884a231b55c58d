#include "engine/video/ops/concatenate.h"

#include <cstddef>
#include <string>
#include <utility>

namespace haarmony::video {
namespace {

class Concatenation final : public FrameSource {
  public:
    explicit Concatenation(std::vector<std::unique_ptr<FrameSource>> sources)
        : format_(sources.front()->format()), sources_(std::move(sources)) {}

    const FrameFormat& format() const override { return format_; }

    Result<bool> next(SourceFrame& frame) override {
        for (; current_ < sources_.size(); ++current_) {
            Result<bool> more = sources_[current_]->next(frame);
            if (!more || *more) return more;
            sources_[current_].reset();
        }
        return false;
    }

  private:
    FrameFormat format_;
    std::vector<std::unique_ptr<FrameSource>> sources_;
    std::size_t current_ = 0;
};

std::string size_of(const FrameFormat& format) {
    return std::to_string(format.width) + " x " + std::to_string(format.height);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> concatenate(
    std::vector<std::unique_ptr<FrameSource>> sources) {
    if (sources.empty()) {
        return Error{ErrorCode::kInvalidArgument,
                     "clips are 0; want at least one to concatenate",
                     "clips"};
    }
    const FrameFormat& first = sources.front()->format();
    for (std::size_t i = 1; i < sources.size(); ++i) {
        const FrameFormat& other = sources[i]->format();
        if (other.width == first.width && other.height == first.height) continue;
        return Error{ErrorCode::kInvalidArgument,
                     "clip " + std::to_string(i) + " is " + size_of(other) +
                         "; the first is " + size_of(first),
                     "clips"};
    }
    return std::unique_ptr<FrameSource>(
        std::make_unique<Concatenation>(std::move(sources)));
}

}  // namespace haarmony::video
