#include "server/api/server_timing.h"

#include <array>
#include <cstdio>

namespace haarmony::server {

std::string server_timing(std::initializer_list<TimedPart> parts) {
    std::string text;
    for (const TimedPart& part : parts) {
        const std::chrono::duration<double, std::milli> took = part.took;
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), ";dur=%.3f", took.count());
        if (!text.empty()) text += ", ";
        text.append(part.name).append(number.data());
    }
    return text;
}

}  // namespace haarmony::server
