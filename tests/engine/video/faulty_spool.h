// A spool in memory that fails or lies when it is told to.
#pragma once

#include <cstdint>
#include <string>

#include "engine/video/spool.h"

namespace haarmony::video::testing {

class FaultySpool final : public Spool {
  public:
    // The call that fails, appends and reads counted together from 0.
    void fail_at(std::int64_t call) { fail_at_ = call; }
    // Changes a bit of what was appended, or changes it back.
    void flip(std::uint64_t offset) {
        bytes_[static_cast<std::size_t>(offset)] ^= std::byte{16};
    }
    [[nodiscard]] std::uint64_t size() const { return bytes_.size(); }
    [[nodiscard]] std::int64_t calls() const { return calls_; }
    [[nodiscard]] std::int64_t appends() const { return appends_; }

    [[nodiscard]] Result<std::uint64_t> append(
        std::span<const std::byte> bytes) override {
        if (calls_++ == fail_at_) return fault();
        ++appends_;
        const std::uint64_t offset = bytes_.size();
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return offset;
    }
    [[nodiscard]] Result<void> read(std::uint64_t offset,
                                    std::span<std::byte> bytes) override {
        if (calls_++ == fail_at_) return fault();
        if (!bytes.empty()) {
            std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
        }
        return {};
    }

  private:
    [[nodiscard]] Error fault() const {
        return {ErrorCode::kIo, "call " + std::to_string(fail_at_)};
    }

    std::vector<std::byte> bytes_;
    std::int64_t fail_at_ = -1;
    std::int64_t calls_ = 0;
    std::int64_t appends_ = 0;
};

}  // namespace haarmony::video::testing
