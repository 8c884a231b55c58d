// Clients that send a picture to be searched for, over and over, as long as they live: the
// costly requests beside which cheap ones are measured.
//
// Threads one for each client.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace haarmony::bench {

class Posters {
  public:
    // `picture` is the bytes of a JPEG and outlives this.
    Posters(std::uint16_t port, int clients, const std::string& picture);
    ~Posters();
    Posters(const Posters&) = delete;
    Posters& operator=(const Posters&) = delete;

    // So many were answered with 200, with 503, and with anything else or not at all.
    [[nodiscard]] int answered() const { return answered_; }
    [[nodiscard]] int refused() const { return refused_; }
    [[nodiscard]] int failed() const { return failed_; }

  private:
    void post(std::uint16_t port, const std::string& picture);

    std::atomic<bool> ending_ = false;
    std::atomic<int> answered_ = 0;
    std::atomic<int> refused_ = 0;
    std::atomic<int> failed_ = 0;
    std::vector<std::thread> threads_;
};

}  // namespace haarmony::bench
