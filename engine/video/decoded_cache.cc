#include "engine/video/decoded_cache.h"

#include <iterator>
#include <utility>

namespace haarmony::video {
namespace {

// Takes the mark of a decoding entry off, whatever the decoder throws.
class OnLeave {
  public:
    explicit OnLeave(std::function<void()> leave) : leave_(std::move(leave)) {}
    ~OnLeave() { leave_(); }
    OnLeave(const OnLeave&) = delete;
    OnLeave& operator=(const OnLeave&) = delete;

  private:
    std::function<void()> leave_;
};

}  // namespace

std::size_t DecodedCache::Hash::operator()(const Key& key) const {
    // The golden ratio spreads the owners over all bits; parts differ in the low ones.
    constexpr std::uint64_t kSpread = 0x9E37'79B9'7F4A'7C15;
    return static_cast<std::size_t>(key.owner * kSpread ^ key.part);
}

DecodedCache::Owner DecodedCache::add_owner() {
    const std::lock_guard lock(mutex_);
    return next_owner_++;
}

void DecodedCache::remove_owner(Owner owner) {
    std::list<Kept> dropped;  // destroyed behind the lock
    const std::lock_guard lock(mutex_);
    for (auto kept = kept_.begin(); kept != kept_.end();) {
        const auto next = std::next(kept);
        if (kept->key.owner == owner) {
            bytes_ -= entries_.at(kept->key).bytes;
            dropped.splice(dropped.begin(), kept_, kept);
        }
        kept = next;
    }
    std::erase_if(entries_, [&](const auto& item) { return item.first.owner == owner; });
}

void DecodedCache::keep(const Key& key,
                        Entry& entry,
                        Value value,
                        std::list<Kept>& dropped) {
    if (entry.kept) {
        kept_.splice(kept_.begin(), kept_, entry.place);
        return;
    }
    kept_.push_front({key, std::move(value)});
    entry.place = kept_.begin();
    entry.kept = true;
    bytes_ += entry.bytes;
    while (bytes_ > limit_) {
        Entry& last = entries_.at(kept_.back().key);
        last.kept = false;
        bytes_ -= last.bytes;
        dropped.splice(dropped.begin(), kept_, std::prev(kept_.end()));
    }
}

void DecodedCache::forget_dead() {
    constexpr std::size_t kFew = 256;
    if (entries_.size() < 2 * kept_.size() + kFew) return;
    std::erase_if(entries_, [](const auto& item) {
        const Entry& entry = item.second;
        return !entry.kept && !entry.decoding && entry.alive.expired();
    });
}

Result<DecodedCache::Value> DecodedCache::get(const Key& key, const Decode& decode) {
    std::list<Kept> dropped;  // destroyed behind the lock
    std::unique_lock lock(mutex_);
    for (;;) {
        Entry& entry = entries_[key];
        if (Value value = entry.alive.lock()) {
            keep(key, entry, value, dropped);
            return value;
        }
        if (!entry.decoding) {
            entry.decoding = true;
            break;
        }
        done_.wait(lock);
    }
    lock.unlock();

    std::list<Kept> dropped_later;
    Result<Decoded> decoded = Decoded{};
    const OnLeave leave([&] {
        const std::lock_guard leaving(mutex_);
        Entry& entry = entries_.at(key);
        entry.decoding = false;
        if (decoded && (*decoded).value != nullptr) {
            ++decoded_;
            entry.alive = (*decoded).value;
            entry.bytes = (*decoded).bytes;
            keep(key, entry, (*decoded).value, dropped_later);
            forget_dead();
        } else {
            entries_.erase(key);
        }
        done_.notify_all();
    });
    decoded = decode();
    if (!decoded) return decoded.error();
    return (*decoded).value;
}

std::size_t DecodedCache::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

std::uint64_t DecodedCache::decoded() const {
    const std::lock_guard lock(mutex_);
    return decoded_;
}

}  // namespace haarmony::video
