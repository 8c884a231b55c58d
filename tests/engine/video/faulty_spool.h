// A spool in memory that fails or lies when it is told to.
#pragma once

#include <gtest/gtest.h>

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

// Makes each of the calls fail that `run` makes of a spool, one after the other: `run` must
// answer with that failure. Run: Result<void>(FaultySpool&).
template <typename Run>
void expect_failures_passed_on(std::int64_t calls, const Run& run) {
    FaultySpool sound;
    ASSERT_TRUE(run(sound).has_value());
    ASSERT_EQ(sound.calls(), calls);
    for (std::int64_t call = 0; call < calls; ++call) {
        FaultySpool faulty;
        faulty.fail_at(call);
        const Result<void> result = run(faulty);
        ASSERT_FALSE(result.has_value()) << call;
        EXPECT_EQ(result.error().message, "call " + std::to_string(call));
    }
}

}  // namespace haarmony::video::testing
