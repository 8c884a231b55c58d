#include "ingest/libav_pixels.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <array>
#include <cstddef>
#include <cstring>
#include <string>

namespace haarmony::ingest {
namespace {

constexpr int kRowAlignment = 64;
constexpr int kBt709Lines = 720;

int matrix_of(const AVFrame& frame) {
    if (frame.colorspace != AVCOL_SPC_UNSPECIFIED && frame.colorspace != AVCOL_SPC_RGB) {
        return frame.colorspace;
    }
    return frame.height >= kBt709Lines ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

std::string name_of(int pixel_format) {
    const char* name = av_get_pix_fmt_name(static_cast<AVPixelFormat>(pixel_format));
    return name == nullptr ? std::to_string(pixel_format) : name;
}

}  // namespace

Result<void> LibavPixels::prepare(const AVFrame& frame) {
    const int matrix = matrix_of(frame);
    if (scaler_ && width_ == frame.width && height_ == frame.height &&
        pixel_format_ == frame.format && matrix_ == matrix &&
        range_ == frame.color_range) {
        return {};
    }
    const auto from = static_cast<AVPixelFormat>(frame.format);
    scaler_.reset(sws_getContext(frame.width,
                                 frame.height,
                                 from,
                                 frame.width,
                                 frame.height,
                                 AV_PIX_FMT_RGBA,
                                 kExactScaling,
                                 nullptr,
                                 nullptr,
                                 nullptr));
    if (!scaler_) {
        return Error{ErrorCode::kUndecodable,
                     "pixels of the format " + name_of(frame.format) + " cannot be read"};
    }
    int* old_table = nullptr;
    int* new_table = nullptr;
    int old_range = 0;
    int new_range = 0;
    int brightness = 0;
    int contrast = 0;
    int saturation = 0;
    // Fails for formats that have no matrix.
    if (sws_getColorspaceDetails(scaler_.get(),
                                 &old_table,
                                 &old_range,
                                 &new_table,
                                 &new_range,
                                 &brightness,
                                 &contrast,
                                 &saturation) >= 0) {
        // Formats that are always full range (yuvj420p) say so themselves.
        const int range = frame.color_range == AVCOL_RANGE_JPEG ? 1 : old_range;
        sws_setColorspaceDetails(scaler_.get(),
                                 sws_getCoefficients(matrix),
                                 range,
                                 sws_getCoefficients(SWS_CS_DEFAULT),
                                 1,
                                 brightness,
                                 contrast,
                                 saturation);
    }
    width_ = frame.width;
    height_ = frame.height;
    pixel_format_ = frame.format;
    matrix_ = matrix;
    range_ = frame.color_range;
    stride_ = (width_ * 4 + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
    rows_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height_) +
                 kRowAlignment);
    return {};
}

Result<void> LibavPixels::convert(const AVFrame& frame, video::Picture& picture) {
    if (auto prepared = prepare(frame); !prepared) return prepared;
    const std::array<std::uint8_t*, 4> planes = {rows_.data(), nullptr, nullptr, nullptr};
    const std::array<int, 4> strides = {stride_, 0, 0, 0};
    const int rows = sws_scale(scaler_.get(),
                               frame.data,
                               frame.linesize,
                               0,
                               height_,
                               planes.data(),
                               strides.data());
    if (rows != height_) {
        return Error{
            ErrorCode::kUndecodable,
            "pixels of the format " + name_of(frame.format) + " cannot be converted"};
    }
    if (picture.width != width_ || picture.height != height_) {
        picture = video::Picture(width_, height_);
    }
    const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(width_);
    for (int y = 0; y < height_; ++y) {
        std::memcpy(&picture.at(0, y),
                    rows_.data() +
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_),
                    row_bytes);
    }
    for (video::Rgba& pixel : picture.pixels) pixel = video::canonical(pixel);
    return {};
}

}  // namespace haarmony::ingest
