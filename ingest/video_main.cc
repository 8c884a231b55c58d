// haarmony-video BYTES: reads a clip or writes a film for haarmonyd and haarmony-ingest, with
// at most BYTES of address space. Started by them with a socket as descriptor 0
// (video_wire.h); of no use by hand.
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>
#include <span>
#include <string>

#include "ingest/confine.h"
#include "ingest/libav_film.h"
#include "ingest/libav_source.h"
#include "ingest/mapping.h"
#include "ingest/socket_wire.h"
#include "ingest/video_wire.h"
#include "ingest/webp_animation.h"

namespace {

using haarmony::Error;
using haarmony::ErrorCode;
using haarmony::Result;
using namespace haarmony::ingest;

constexpr int kSocket = 0;
constexpr int kDone = 0;
constexpr int kPeerGone = 1;
constexpr int kByHand = 2;
constexpr int kNotConfined = 3;

bool send_reply(const VideoReply& reply) {
    return send_all(kSocket, &reply, sizeof(reply));
}

int fail(const Error& error) {
    std::string text = error.message;
    if (text.size() > kMaxVideoMessage) text.resize(kMaxVideoMessage);
    VideoReply reply;
    reply.kind = VideoReplyKind::kFailed;
    reply.error = error.code;
    reply.length = text.size();
    const bool sent = send_reply(reply) && send_all(kSocket, text.data(), text.size());
    return sent ? kDone : kPeerGone;
}

bool done() {
    VideoReply reply;
    reply.kind = VideoReplyKind::kDone;
    return send_reply(reply);
}

Result<std::unique_ptr<PictureSource>> open_source(const VideoRequest& request,
                                                   int file,
                                                   std::unique_ptr<Mapping>& mapping) {
    if (request.source != VideoFormat::kWebp) {
        return open_libav_source(file,
                                 {.format = request.source,
                                  .frames = request.frames,
                                  .max_pixels = request.max_pixels});
    }
    struct stat look {};
    if (::fstat(file, &look) != 0) look.st_size = 0;
    mapping = std::make_unique<Mapping>(file, static_cast<std::size_t>(look.st_size));
    if (!mapping->mapped()) {
        return Error{ErrorCode::kTooLarge,
                     "a WebP of " + std::to_string(look.st_size) +
                         " bytes needs more memory than it may have"};
    }
    return open_webp_animation(mapping->bytes(), request.max_pixels);
}

int read_clip(const VideoRequest& request, const FileDescriptor& file) {
    if (!allow_seconds(request.cpu_seconds)) return kNotConfined;
    std::unique_ptr<Mapping> mapping;
    const auto source = open_source(request, file.get(), mapping);
    if (!source) return fail(source.error());
    VideoReply reply;
    reply.kind = VideoReplyKind::kOpened;
    reply.format = (*source)->format();
    if (!send_reply(reply)) return kPeerGone;
    TimedPicture shown;
    for (;;) {
        const Result<bool> more = (*source)->next(shown);
        if (!more) return fail(more.error());
        if (!*more) return done() ? kDone : kPeerGone;
        reply.kind = VideoReplyKind::kPicture;
        reply.time_us = shown.time_us;
        reply.length = picture_bytes(reply.format);
        if (!send_reply(reply) ||
            !send_all(kSocket, shown.picture.pixels.data(), reply.length)) {
            return kPeerGone;
        }
    }
}

bool send_part(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const auto part = bytes.first(std::min<std::size_t>(bytes.size(), kMaxFilmPart));
        VideoReply reply;
        reply.kind = VideoReplyKind::kBytes;
        reply.length = part.size();
        if (!send_reply(reply) || !send_all(kSocket, part.data(), part.size())) {
            return false;
        }
        bytes = bytes.subspan(part.size());
    }
    return true;
}

int write_film(const VideoRequest& request) {
    LibavFilm film;
    if (auto opened = film.open(request, send_part); !opened) return fail(opened.error());
    if (!done()) return kPeerGone;
    haarmony::video::Picture picture(request.format.width, request.format.height);
    for (;;) {
        FilmMessage message;
        if (!receive_all(kSocket, &message, sizeof(message)) ||
            message.magic != kVideoMagic) {
            return kPeerGone;
        }
        if (message.step == FilmStep::kFinish) {
            if (auto finished = film.finish(); !finished) return fail(finished.error());
            return done() ? kDone : kPeerGone;
        }
        if (!receive_all(kSocket, picture.pixels.data(), picture_bytes(request.format))) {
            return kPeerGone;
        }
        if (auto added = film.add(picture); !added) return fail(added.error());
        if (!done()) return kPeerGone;
    }
}

int serve() {
    VideoRequest request;
    FileDescriptor file;
    if (!receive_with_file(kSocket, &request, sizeof(request), file) ||
        request.magic != kVideoMagic) {
        return kPeerGone;
    }
    if (request.task != VideoTask::kRead) return write_film(request);
    return file.valid() ? read_clip(request, file) : kPeerGone;
}

}  // namespace

int main(int argc, char** argv) {
    const std::uint64_t address_space = address_space_argument(argc, argv);
    if (address_space == 0) {
        std::fputs(
            "haarmony-video is started by haarmonyd and haarmony-ingest, not by hand.\n",
            stderr);
        return kByHand;
    }
    if (!confine(address_space)) return kNotConfined;
    try {
        return serve();
    } catch (const std::bad_alloc&) {
        return fail(
            {ErrorCode::kTooLarge, "this video needs more memory than it may have"});
    }
}
