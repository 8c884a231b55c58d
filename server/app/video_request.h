// What a video job is asked to make, as its row keeps it.
//
//   server/api/video_upload -> [video_request] -> video_job
//
// Shape    a JSON object; clients see it in the job, so it names no path of the disk but
//          those that a client named himself.
// Errors   kInvalidArgument for text that to_text() has not written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/generate/generator.h"
#include "server/app/composition_request.h"

namespace haarmony::server {

// What becomes of the frames, wherever they come from.
struct VideoWishes {
    std::string name;
    double delta = 0;             // in grey levels
    std::int64_t max_frames = 0;  // 0: all
    bool index = false;           // signatures, so that /query finds its frames
};

enum class VideoOrigin {
    kRaw,        // input: frames of straight RGBA, one after the other
    kLeaves,     // input: leaf_frames.h
    kClip,       // input: a .mrv file
    kGenerated,  // by a generator
    kComposed,   // input: the still pictures, if there are any
    kMedia,      // input, or path: what video_media.h reads
};

struct VideoRequest {
    VideoOrigin origin = VideoOrigin::kRaw;
    VideoWishes wishes;
    std::string input;          // of VideoFiles
    video::FrameFormat format;  // of kRaw and kLeaves
    std::string generator;      // its name
    video::GeneratorParameters parameters;
    CompositionRequest composition;
    std::string path = {};  // below a media root, as the client named it
    // The video whose frames these follow; a new one where there is none.
    std::optional<std::int64_t> append_to = {};
};

[[nodiscard]] std::string to_text(const VideoRequest& request);
[[nodiscard]] Result<VideoRequest> video_request_of(std::string_view text);

// The input that the request of a job names, if it names one.
[[nodiscard]] std::optional<std::string> input_of_request(std::string_view text);

// The fraction that a client means by a number: the one with the smallest denominator that
// is nearest among those up to 1001, or the nearest thousandth. Requires: 0.001 <= rate <= 1000.
[[nodiscard]] video::FrameRate rate_of(double per_second);

// In the engine's unit. Requires: 0 <= delta <= 255.
[[nodiscard]] std::uint32_t delta_units(double delta);

}  // namespace haarmony::server
