#include "ingest/unsupported.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>

#include "ingest/sniff.h"

namespace haarmony::ingest {

Error unsupported_format(std::span<const std::uint8_t> bytes, std::string_view thing) {
    const std::optional<FileType> type = sniff(bytes);
    std::string message;
    if (bytes.empty()) {
        message = "the " + std::string(thing) + " is empty (0 bytes)";
    } else if (type) {
        message = std::string(type->name) + " (" + std::string(type->media_type) +
                  ") is not a format that is read here";
    } else {
        message = "unknown format: the first bytes are";
        for (const std::uint8_t byte :
             bytes.first(std::min<std::size_t>(bytes.size(), 8))) {
            std::array<char, 4> hex{};
            std::snprintf(hex.data(), hex.size(), " %02x", byte);
            message += hex.data();
        }
    }
    return {ErrorCode::kUnsupportedFormat, message};
}

}  // namespace haarmony::ingest
