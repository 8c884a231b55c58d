#include "ingest/media_fragment.h"

#include <cassert>

namespace haarmony::ingest {
namespace {

constexpr std::string_view kTime = "#t=";
constexpr std::int64_t kMicrosecondsAMillisecond = 1'000;

}  // namespace

std::string key_frame_prefix(std::string_view film) {
    assert(film.find('#') == std::string_view::npos);
    return std::string(film) + std::string(kTime);
}

std::string key_frame_uri(std::string_view film, std::int64_t time_us) {
    assert(time_us >= 0);
    const std::int64_t ms =
        (time_us + kMicrosecondsAMillisecond / 2) / kMicrosecondsAMillisecond;
    const std::string decimals = std::to_string(1'000 + ms % 1'000).substr(1);
    return key_frame_prefix(film) + std::to_string(ms / 1'000) + '.' + decimals;
}

bool is_key_frame_uri(std::string_view uri) {
    return uri.find(kTime) != std::string_view::npos;
}

std::string_view without_fragment(std::string_view uri) {
    return uri.substr(0, uri.find('#'));
}

}  // namespace haarmony::ingest
