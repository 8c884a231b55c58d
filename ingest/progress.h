// What a run says while it goes on, and at its end.
//
// kBar    one line of a terminal, drawn at once and over again; kPlain: lines "progress: ...", seldom.
//         Both end with "done: seen=N added=N updated=N skipped=N failed=N pruned=N
//         seconds=S".   kNone: only that line.
// kJson   one JSON object a line, told apart by "event": "progress", "failed", "done".
// Always  each failure at once on the error stream, as "failed: PATH: REASON". Bytes that
//         would break the line or steer a terminal are written as \xNN.
//
// Units   rates in files per second, over about the last kRateMemory; times in seconds.
// Threads one thread at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "ingest/tally.h"
#include "ingest/writer.h"

namespace haarmony::ingest {

enum class ProgressMode { kBar, kPlain, kNone, kJson };

inline constexpr std::chrono::milliseconds kBarInterval{100};
inline constexpr std::chrono::milliseconds kJsonInterval{500};
inline constexpr std::chrono::milliseconds kPlainInterval{2000};
inline constexpr std::chrono::seconds kRateMemory{5};

// Files per second, forgetting what is long past: unchanged files are skipped a hundred
// times faster than new ones are decoded, and the average of both foretells nothing.
class Rate {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    explicit Rate(TimePoint start) : last_time_(start) {}

    // Requires: `count` and `now` never fall.
    void update(std::int64_t count, TimePoint now);
    [[nodiscard]] double per_second() const { return weight_ > 0 ? sum_ / weight_ : 0; }
    // Nothing while the rate is zero.
    [[nodiscard]] std::optional<double> seconds_for(std::int64_t count) const;

  private:
    TimePoint last_time_;
    std::int64_t last_count_ = 0;
    double sum_ = 0;     // of rates, each weighted by its share of the time
    double weight_ = 0;  // of those shares: below 1 until kRateMemory is filled
};

class Progress final : public Observer {
  public:
    using Clock = std::chrono::steady_clock;

    // `columns`: width of the terminal, for kBar. The streams outlive this.
    Progress(ProgressMode mode,
             int columns,
             std::ostream& out,
             std::ostream& err,
             std::function<Clock::time_point()> clock);

    void failed(const std::string& path, const std::string& reason) override;
    void progress(const Tally& tally, std::int64_t total) override;
    void done(const Tally& tally);

  private:
    void draw_bar(const Tally& tally, std::int64_t total);
    void clear_bar();
    [[nodiscard]] std::optional<double> eta_s(const Tally& tally,
                                              std::int64_t total) const;

    const ProgressMode mode_;
    const int columns_;
    std::ostream& out_;
    std::ostream& err_;
    const std::function<Clock::time_point()> clock_;
    const Clock::time_point start_;
    Clock::time_point next_;
    Rate rate_;
    bool bar_shown_ = false;
};

// `text` with control bytes as escapes, so that it is one line.
[[nodiscard]] std::string printable_line(std::string_view text);

}  // namespace haarmony::ingest
