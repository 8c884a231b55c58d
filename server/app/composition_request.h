// A composition of videos and still pictures as its job's row keeps it, and opened.
//
//   server/api/video_compose -> [composition_request] -> engine/video/ops/compose.h
//
// Shape    the pixels of still pictures wait in the job's input, straight RGBA, one after
//          the other. A still picture stays from its start to the end of the videos.
// Errors   kInvalidArgument for text that to_text() has not written; kNotFound for a video
//          that is gone; what the engine refuses, with its param.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/memory_clip.h"
#include "engine/video/ops/compose.h"
#include "server/app/video_service.h"

namespace haarmony::server {

// Where a still picture is in the input.
struct StillPicture {
    std::uint64_t offset = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;
};

struct LayerRequest {
    std::int64_t video = 0;  // 0: a still picture
    StillPicture still;
    std::int64_t dx = 0;
    std::int64_t dy = 0;
    std::optional<int> at_level = {};
    double scale_x = 1;
    double scale_y = 1;
    std::int64_t start = 0;
    std::string op = "a_over_b";
};

struct CompositionRequest {
    std::vector<LayerRequest> layers;  // the lowest first
    // A side of 0 is that of the lowest layer, and so is a rate that is not given.
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::optional<video::FrameRate> rate = {};
};

[[nodiscard]] std::string to_text(const CompositionRequest& request);
[[nodiscard]] Result<CompositionRequest> composition_request_of(std::string_view text);

// The layers, and what they show.
class OpenComposition {
  public:
    // `stills` are the pixels of the input. Refuses what cannot be composed.
    [[nodiscard]] static Result<OpenComposition> open(VideoService& videos,
                                                      const CompositionRequest& request,
                                                      std::span<const std::byte> stills);

    [[nodiscard]] const std::vector<video::CompositionLayer>& layers() const {
        return layers_;
    }
    [[nodiscard]] const video::FrameFormat& canvas() const { return canvas_; }
    [[nodiscard]] const video::ClipShape& shape() const { return *shape_; }

  private:
    std::vector<std::shared_ptr<const OpenVideo>> videos_;
    std::vector<std::unique_ptr<video::MemoryClip>> stills_;
    std::vector<video::CompositionLayer> layers_;
    video::FrameFormat canvas_;
    std::optional<video::ClipShape> shape_;
};

}  // namespace haarmony::server
