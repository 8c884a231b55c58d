// A client for tests: a bare TCP socket that sends whatever bytes a test wants, in whatever
// pieces, and reads answers strictly. It shares no code with the server.
//
// Errors  a failed connect() or a malformed answer throws std::runtime_error, which fails the
//         test with its text. No read waits longer than kPatience.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace haarmony::test {

inline constexpr std::chrono::seconds kPatience{20};

struct HttpReply {
    int status = 0;
    std::string reason;
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;                            // without its chunked coding
    bool until_close = false;  // the end of the connection ended the body

    [[nodiscard]] std::string header(const std::string& lower_case_name) const;
};

class HttpClient {
  public:
    explicit HttpClient(std::uint16_t port);
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    // False once the other side refuses to take more.
    bool send(std::string_view bytes);
    void finish_sending();  // closes this half: the server sees the end
    void reset();           // drops the connection with a RST

    // The next answer. `head_only`: to a HEAD request, whose answer has no body.
    [[nodiscard]] HttpReply receive(bool head_only = false);
    // Status line and headers only; the body is left to read_some().
    [[nodiscard]] HttpReply receive_head();
    // What arrives next, at least one byte; empty at the end.
    [[nodiscard]] std::string read_some();
    // Whether the server has closed: waits until it says something, and that is the end.
    [[nodiscard]] bool at_end();

    // GET with a Host header, on this connection.
    [[nodiscard]] HttpReply get(std::string_view target,
                                std::string_view more_headers = {});
    [[nodiscard]] HttpReply request(std::string_view method,
                                    std::string_view target,
                                    std::string_view more_headers = {},
                                    std::string_view body = {});

  private:
    bool more();  // false at the end
    [[nodiscard]] std::string line();
    [[nodiscard]] std::string exactly(std::size_t bytes);
    [[nodiscard]] std::string chunked_body();

    int descriptor_ = -1;
    std::string buffer_;
};

}  // namespace haarmony::test
