#include "ingest/libav.h"

#include <array>

namespace haarmony::ingest {

std::string libav_words(int code) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(code, text.data(), text.size());
    return text.data();
}

}  // namespace haarmony::ingest
