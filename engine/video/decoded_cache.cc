#include "engine/video/decoded_cache.h"

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

void DecodedCache::keep(std::uint64_t key,
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

Result<DecodedCache::Value> DecodedCache::get(std::uint64_t key, const Decode& decode) {
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
