// What was decoded last, kept while there is room; what is in use anyway is found again.
//   [decoded_cache.h] -> mrv_clip.h
//
// Units    bytes in memory, as the decoder says.
// Errors   what the decoder says; nothing is kept then.
// Threads  thread-safe; two that want the same decode it once, and no lock is held meanwhile.
//          A decoder may ask for other keys, as long as no key asks for itself in the end.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "engine/core/result.h"

namespace haarmony::video {

class DecodedCache {
  public:
    using Value = std::shared_ptr<const void>;
    struct Decoded {
        Value value;
        std::size_t bytes = 0;
    };
    using Decode = std::function<Result<Decoded>()>;

    // `limit` bounds what is kept although no one holds on to it.
    explicit DecodedCache(std::size_t limit) : limit_(limit) {}

    [[nodiscard]] Result<Value> get(std::uint64_t key, const Decode& decode);
    // Of what is kept.
    [[nodiscard]] std::size_t bytes() const;
    // How often something was decoded.
    [[nodiscard]] std::uint64_t decoded() const;

  private:
    struct Kept {
        std::uint64_t key;
        Value value;
    };
    struct Entry {
        std::weak_ptr<const void> alive;
        std::size_t bytes = 0;
        bool decoding = false;
        bool kept = false;
        std::list<Kept>::iterator place;  // where kept
    };

    void keep(std::uint64_t key, Entry& entry, Value value, std::list<Kept>& dropped);
    void forget_dead();

    const std::size_t limit_;
    mutable std::mutex mutex_;  // guards all that follows
    std::condition_variable done_;
    std::unordered_map<std::uint64_t, Entry> entries_;
    std::list<Kept> kept_;  // the last used first
    std::size_t bytes_ = 0;
    std::uint64_t decoded_ = 0;
};

}  // namespace haarmony::video
