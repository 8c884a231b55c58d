// libav's objects as values that free themselves, and its errors in our words.
//
// Errors  as Result: foreign codes die here.
// Threads as libav's: one caller an object.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>

namespace haarmony::ingest {

struct FreeLibav {
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
    void operator()(AVIOContext* io) const {
        av_freep(&io->buffer);
        avio_context_free(&io);
    }
};

template <typename T>
using Libav = std::unique_ptr<T, FreeLibav>;

// What a negative return value means.
[[nodiscard]] std::string libav_words(int code);

// A name and value of an options dictionary, freed with the scope.
class LibavOptions {
  public:
    LibavOptions() = default;
    ~LibavOptions() { av_dict_free(&entries_); }
    LibavOptions(const LibavOptions&) = delete;
    LibavOptions& operator=(const LibavOptions&) = delete;

    void set(const char* name, const char* value) {
        av_dict_set(&entries_, name, value, 0);
    }
    void set(const char* name, std::int64_t value) {
        av_dict_set_int(&entries_, name, value, 0);
    }
    [[nodiscard]] AVDictionary** get() { return &entries_; }

  private:
    AVDictionary* entries_ = nullptr;
};

// What swscale needs for the same bytes on every machine.
inline constexpr int kExactScaling = SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT |
                                     SWS_FULL_CHR_H_INP | SWS_BITEXACT;

}  // namespace haarmony::ingest
