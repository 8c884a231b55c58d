#include "server/app/reply_cache.h"

#include <iterator>

namespace haarmony::server {
namespace {

// Of one request that is spelt in ever new ways only so many spellings are remembered.
constexpr std::size_t kMostAliases = 8;
// What an entry costs beside its bytes and its names.
constexpr std::size_t kEntryBytes = 512;

}  // namespace

ReplyCache::Reply ReplyCache::find(const std::string& key, const std::string& alias) {
    const std::lock_guard lock(mutex_);
    const auto found = keys_.find(key);
    if (found == keys_.end()) return nullptr;
    list_.splice(list_.begin(), list_, found->second);
    add_alias(list_.begin(), alias);
    Reply reply = list_.front().reply;
    make_room();
    return reply;
}

void ReplyCache::put(std::int64_t video,
                     const std::string& key,
                     const std::string& alias,
                     Reply reply) {
    const std::lock_guard lock(mutex_);
    if (const auto known = keys_.find(key); known != keys_.end()) drop(known->second);
    Kept kept{key, video, std::move(reply), {}, 0};
    kept.bytes = kEntryBytes + key.size() + kept.reply->bytes.size();
    bytes_ += kept.bytes;
    list_.push_front(std::move(kept));
    keys_.emplace(key, list_.begin());
    add_alias(list_.begin(), alias);
    make_room();
}

bool ReplyCache::knows(std::string_view alias) const {
    const std::lock_guard lock(mutex_);
    return aliases_.contains(alias);
}

void ReplyCache::forget(std::int64_t video) {
    const std::lock_guard lock(mutex_);
    for (auto kept = list_.begin(); kept != list_.end();) {
        const auto next = std::next(kept);
        if (kept->video == video) drop(kept);
        kept = next;
    }
}

std::size_t ReplyCache::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

void ReplyCache::add_alias(List::iterator kept, const std::string& alias) {
    if (kept->aliases.size() >= kMostAliases || aliases_.contains(alias)) return;
    aliases_.emplace(alias, kept);
    kept->aliases.insert(alias);
    kept->bytes += alias.size();
    bytes_ += alias.size();
}

void ReplyCache::drop(List::iterator kept) {
    for (const std::string& alias : kept->aliases) aliases_.erase(alias);
    keys_.erase(kept->key);
    bytes_ -= kept->bytes;
    list_.erase(kept);
}

void ReplyCache::make_room() {
    while (bytes_ > most_bytes_ && !list_.empty()) drop(std::prev(list_.end()));
}

}  // namespace haarmony::server
