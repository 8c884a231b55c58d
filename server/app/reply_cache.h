// Encoded pictures of videos, kept while there is room: the longest unused goes first.
//
// Shape    a key names all that the reply depends on; an alias is another spelling of it, as
//          a request has it, by which a reply can be known before the request is understood.
// Threads  every member from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace haarmony::server {

// What a picture's reply says.
struct PictureReply {
    std::string bytes;
    int width = 0;
    int height = 0;
    std::int64_t first_frame = 0;  // of those that it averages
    std::int64_t last_frame = 0;
    bool finer_in_space = false;
    bool finer_in_time = false;
};

class ReplyCache {
  public:
    explicit ReplyCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    using Reply = std::shared_ptr<const PictureReply>;

    // Null where it is not kept. `alias` is remembered as another name of the key.
    [[nodiscard]] Reply find(const std::string& key, const std::string& alias);
    // What is larger than all the room is not kept.
    void put(std::int64_t video,
             const std::string& key,
             const std::string& alias,
             Reply reply);
    [[nodiscard]] bool knows(std::string_view alias) const;
    // All replies of a video.
    void forget(std::int64_t video);

    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Kept {
        std::string key;
        std::int64_t video = 0;
        Reply reply;
        std::set<std::string> aliases;
        std::size_t bytes = 0;
    };
    using List = std::list<Kept>;  // the most recently used first

    void add_alias(List::iterator kept, const std::string& alias);
    void drop(List::iterator kept);
    void make_room();

    const std::size_t most_bytes_;
    mutable std::mutex mutex_;  // guards the rest
    List list_;
    std::map<std::string, List::iterator, std::less<>> keys_;
    std::map<std::string, List::iterator, std::less<>> aliases_;
    std::size_t bytes_ = 0;
};

}  // namespace haarmony::server
