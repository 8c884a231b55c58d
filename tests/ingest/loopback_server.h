// A web server of one thread on 127.0.0.1 that says what the test tells it to.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <thread>

#include "ingest/file_descriptor.h"

namespace haarmony::ingest {

class LoopbackServer {
  public:
    // Path to raw response. kSilence answers nothing until the server goes away.
    static constexpr const char* kSilence = "(silence)";
    explicit LoopbackServer(std::map<std::string, std::string> responses);
    ~LoopbackServer();
    LoopbackServer(const LoopbackServer&) = delete;
    LoopbackServer& operator=(const LoopbackServer&) = delete;

    [[nodiscard]] std::string url(const std::string& path) const;
    [[nodiscard]] int requests() const { return requests_; }

  private:
    void serve();
    void answer(const FileDescriptor& connection);

    std::map<std::string, std::string> responses_;
    FileDescriptor listener_;
    FileDescriptor stop_read_;
    FileDescriptor stop_write_;
    int port_ = 0;
    std::atomic<int> requests_{0};
    std::thread thread_;
};

// A whole response with its length.
[[nodiscard]] std::string http_ok(const std::string& body);
[[nodiscard]] std::string http_redirect(const std::string& location);

}  // namespace haarmony::ingest
