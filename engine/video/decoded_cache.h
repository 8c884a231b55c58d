// What was decoded last, kept while there is room; what is in use anyway is found again.
//   [decoded_cache.h] -> mrv_clip.h
//
// Shape    several owners (clips) share one cache and its limit; keys of different owners
//          never meet.
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
    using Owner = std::uint64_t;
    struct Key {
        Owner owner = 0;
        std::uint64_t part = 0;

        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Decoded {
        Value value;
        std::size_t bytes = 0;
    };
    using Decode = std::function<Result<Decoded>()>;

    // `limit` bounds what is kept although no one holds on to it.
    explicit DecodedCache(std::size_t limit) : limit_(limit) {}

    // One that nobody else has.
    [[nodiscard]] Owner add_owner();
    // Lets go of all that is the owner's. Requires: nobody asks for it any more.
    void remove_owner(Owner owner);

    [[nodiscard]] Result<Value> get(const Key& key, const Decode& decode);
    // Of what is kept, of all owners.
    [[nodiscard]] std::size_t bytes() const;
    // How often something was decoded.
    [[nodiscard]] std::uint64_t decoded() const;

  private:
    struct Kept {
        Key key;
        Value value;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const;
    };
    struct Entry {
        std::weak_ptr<const void> alive;
        std::size_t bytes = 0;
        bool decoding = false;
        bool kept = false;
        std::list<Kept>::iterator place;  // where kept
    };

    void keep(const Key& key, Entry& entry, Value value, std::list<Kept>& dropped);
    void forget_dead();

    const std::size_t limit_;
    mutable std::mutex mutex_;  // guards all that follows
    std::condition_variable done_;
    std::unordered_map<Key, Entry, Hash> entries_;
    std::list<Kept> kept_;  // the last used first
    std::size_t bytes_ = 0;
    std::uint64_t decoded_ = 0;
    Owner next_owner_ = 0;
};

}  // namespace haarmony::video
