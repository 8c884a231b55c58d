// Steps that take any bytes for a picture, except those that begin with "bad"; the content
// hash is the content. What a run asked for is counted.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "ingest/pipeline.h"

namespace haarmony::ingest {

struct PretendedPictures {
    std::atomic<int> described = 0;
    std::atomic<int> hashed = 0;
    std::function<void(const std::string& content)> while_describing =
        [](const std::string&) {};

    MakePictureSteps steps() {
        return [this] {
            return PictureSteps{
                [this](std::span<const std::uint8_t> bytes) -> Result<schema::NewImage> {
                    ++described;
                    const std::string content(bytes.begin(), bytes.end());
                    while_describing(content);
                    if (content.starts_with("bad")) {
                        return Error{
                            ErrorCode::kUndecodable,
                            content == "bad and silent" ? "" : "damaged: " + content,
                            {}};
                    }
                    schema::NewImage image;
                    image.stamp.content_hash = content;
                    image.width = static_cast<int>(bytes.size());
                    image.signature.assign(bytes.begin(), bytes.end());
                    return image;
                },
                [this](std::span<const std::uint8_t> bytes) {
                    ++hashed;
                    return std::string(bytes.begin(), bytes.end());
                }};
        };
    }
};

class RecordingObserver final : public Observer {
  public:
    void failed(const std::string& path, const std::string& reason) override {
        failures.push_back(path + ": " + reason);
    }
    void progress(const Tally& tally, std::int64_t total) override {
        last_tally = tally;
        last_total = total;
    }

    std::vector<std::string> failures;
    Tally last_tally;
    std::int64_t last_total = -1;
};

}  // namespace haarmony::ingest
