// What a client says about a picture beside its pixels: uri, tags, metadata.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/api/inputs.h"
#include "server/app/image_service.h"

namespace haarmony::server {

inline constexpr std::size_t kMaxTags = 256;
inline constexpr std::size_t kMaxTagBytes = 128;
inline constexpr std::size_t kMaxUriBytes = 8192;
inline constexpr std::size_t kMaxMetadataBytes = 65'536;

// Each is absent where the request does not say it; problems are left in `inputs`.
struct GivenAttributes {
    std::optional<std::string> uri;
    std::optional<std::vector<std::string>> tags;
    std::optional<std::string> metadata;
};

[[nodiscard]] GivenAttributes read_attributes(Inputs& inputs);

// "tags" alone: separated by commas or a JSON array, blanks around each dropped. No tag is
// empty or holds a comma, or a list could not name it.
[[nodiscard]] std::optional<std::vector<std::string>> read_tags(Inputs& inputs);

}  // namespace haarmony::server
