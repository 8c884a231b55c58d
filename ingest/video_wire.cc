#include "ingest/video_wire.h"

namespace haarmony::ingest {
namespace {

bool check_failure(const VideoReply& reply) {
    switch (reply.error) {
        case ErrorCode::kInvalidArgument:
        case ErrorCode::kUnsupportedFormat:
        case ErrorCode::kUndecodable:
        case ErrorCode::kTooLarge:
        case ErrorCode::kUnavailable:
            return reply.length <= kMaxVideoMessage;
        default:
            return false;
    }
}

bool check_opened(const VideoReply& reply, std::int64_t max_pixels) {
    const video::FrameFormat& format = reply.format;
    return format.width >= 1 && format.width <= video::kMaxSide && format.height >= 1 &&
           format.height <= video::kMaxSide &&
           std::int64_t{format.width} * format.height <= max_pixels &&
           format.rate.numerator >= 1 && format.rate.denominator >= 1 &&
           reply.length == 0;
}

}  // namespace

std::uint64_t picture_bytes(const video::FrameFormat& format) {
    return std::uint64_t{4} * static_cast<std::uint64_t>(format.width) *
           static_cast<std::uint64_t>(format.height);
}

bool check_read_reply(const VideoReply& reply,
                      const video::FrameFormat& format,
                      std::int64_t max_pixels) {
    if (reply.magic != kVideoMagic) return false;
    const bool opened = format.width > 0;
    switch (reply.kind) {
        case VideoReplyKind::kOpened:
            return !opened && check_opened(reply, max_pixels);
        case VideoReplyKind::kPicture:
            return opened && reply.length == picture_bytes(format);
        case VideoReplyKind::kDone:
            return opened && reply.length == 0;
        case VideoReplyKind::kFailed:
            return check_failure(reply);
        default:
            return false;
    }
}

bool check_film_reply(const VideoReply& reply) {
    if (reply.magic != kVideoMagic) return false;
    switch (reply.kind) {
        case VideoReplyKind::kBytes:
            return reply.length >= 1 && reply.length <= kMaxFilmPart;
        case VideoReplyKind::kDone:
            return reply.length == 0;
        case VideoReplyKind::kFailed:
            return check_failure(reply);
        default:
            return false;
    }
}

}  // namespace haarmony::ingest
