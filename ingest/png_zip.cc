#include "ingest/png_zip.h"

#include <string>
#include <utility>

#include "ingest/png_chunks.h"
#include "ingest/zip_writer.h"

namespace haarmony::ingest {
namespace {

constexpr std::size_t kDigits = 6;

class PngZip : public VideoSink {
  public:
    explicit PngZip(FilmOutput output) : output_(std::move(output)) {}

    [[nodiscard]] Result<void> add(const ImageView& picture) override {
        const Result<Bytes> file = png_file(picture);
        if (!file) return file.error();
        const std::string number = std::to_string(frames_++);
        const std::string zeros(kDigits - number.size(), '0');
        const Result<Bytes> bytes = archive_.entry(zeros + number + ".png", *file);
        if (!bytes) return bytes.error();
        return output_(*bytes);
    }
    [[nodiscard]] Result<void> finish() override { return output_(archive_.end()); }

  private:
    FilmOutput output_;
    ZipWriter archive_{0};
    std::int64_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<VideoSink>> open_png_zip(const VideoSinkOptions& options,
                                                FilmOutput output) {
    if (options.frames > kMaxZipEntries) {
        return Error{ErrorCode::kTooLarge,
                     "a ZIP archive has at most " + std::to_string(kMaxZipEntries) +
                         " pictures, not " + std::to_string(options.frames),
                     "frames"};
    }
    return std::unique_ptr<VideoSink>(std::make_unique<PngZip>(std::move(output)));
}

}  // namespace haarmony::ingest
