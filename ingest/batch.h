// When readings that wait to be written are due: many rows a transaction, and none waiting
// long, so that a daemon on the same database follows within a moment.
//
// Units   steady-clock time points, given by the caller.
// Threads one thread at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ingest/change.h"

namespace haarmony::ingest {

inline constexpr std::size_t kBatchRows = 256;
// The contract is a commit every 250 ms; the rest is time for the transaction itself.
inline constexpr std::chrono::milliseconds kBatchWindow{150};

struct FileReading {
    std::string path;
    std::string uri;
    Reading reading;
    bool is_film = false;
    bool has_key_frames = false;  // rows of key frames that were known when it was read
};

class Batch {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    void add(FileReading reading, TimePoint now) {
        if (readings_.empty()) deadline_ = now + kBatchWindow;
        readings_.push_back(std::move(reading));
    }

    [[nodiscard]] bool empty() const { return readings_.empty(); }
    [[nodiscard]] bool due(TimePoint now) const {
        return readings_.size() >= kBatchRows || (!empty() && now >= deadline_);
    }
    // Requires: not empty.
    [[nodiscard]] TimePoint deadline() const { return deadline_; }

    [[nodiscard]] const std::vector<FileReading>& readings() const { return readings_; }
    void clear() { readings_.clear(); }

  private:
    std::vector<FileReading> readings_;
    TimePoint deadline_;
};

}  // namespace haarmony::ingest
