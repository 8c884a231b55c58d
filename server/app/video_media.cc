#include "server/app/video_media.h"

#include <fcntl.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "ingest/file_descriptor.h"
#include "ingest/picture_sequence.h"
#include "ingest/video_source.h"

namespace haarmony::server {
namespace {

Result<std::unique_ptr<ingest::PictureSource>> open_folder(
    const std::string& path,
    const MediaRoots& media_roots) {
    ingest::PictureSequenceOptions options;
    auto files = ingest::pictures_in(path);
    if (!files) return files.error();
    for (const std::string& file : *files) {
        auto real = media_roots.locate_path(file);
        if (!real) return real.error();
        options.files.push_back(*std::move(real));
    }
    return ingest::open_picture_sequence(std::move(options));
}

Result<std::unique_ptr<ingest::PictureSource>> open_film(const std::string& path) {
    // A pipe in the place of the file must not block the thread that opens it.
    ingest::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid())
        return Error{ErrorCode::kNotFound, "the film's file cannot be opened"};
    return ingest::open_video(std::move(file), {});
}

}  // namespace

Result<std::unique_ptr<video::FrameSource>> open_media(const std::string& path,
                                                       const MediaRoots& media_roots) {
    std::error_code error;
    auto pictures = std::filesystem::is_directory(path, error)
                        ? open_folder(path, media_roots)
                        : open_film(path);
    if (!pictures) return pictures.error();
    return std::unique_ptr<video::FrameSource>(
        std::make_unique<ingest::PictureFrameSource>(*std::move(pictures)));
}

}  // namespace haarmony::server
