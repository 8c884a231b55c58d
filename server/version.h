// Which program this is; the number is the project's in CMakeLists.txt.
#pragma once

#include <string_view>

namespace haarmony::server {

inline constexpr std::string_view kVersion = HAARMONY_VERSION;
inline constexpr int kApiVersion = 1;

}  // namespace haarmony::server
