// Bytes put aside while a clip is built: written once, read back by offset.
//
// Errors   kIo where the storage says no.
// Threads  one caller.
// Source   DESIGN of the project, "File": two passes, since the root's average comes last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::video {

class Spool {
  public:
    virtual ~Spool() = default;
    // Appends, and says at which offset.
    [[nodiscard]] virtual Result<std::uint64_t> append(
        std::span<const std::byte> bytes) = 0;
    // Requires: bytes that were appended.
    [[nodiscard]] virtual Result<void> read(std::uint64_t offset,
                                            std::span<std::byte> bytes) = 0;
};

class MemorySpool final : public Spool {
  public:
    [[nodiscard]] Result<std::uint64_t> append(
        std::span<const std::byte> bytes) override {
        const std::uint64_t offset = bytes_.size();
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return offset;
    }
    [[nodiscard]] Result<void> read(std::uint64_t offset,
                                    std::span<std::byte> bytes) override {
        if (!bytes.empty())
            std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
        return {};
    }

  private:
    std::vector<std::byte> bytes_;
};

}  // namespace haarmony::video
