// An HTTP client that shares no code with the server under test: libcurl.
//
// Errors  a request that gets no answer has status 0 and libcurl's words in `body`.
// Threads one client, one thread; it keeps its connection.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace haarmony::testing {

struct Reply {
    long status = 0;
    std::map<std::string, std::string> headers;  // names in lower case
    std::string body;
};

class CurlClient {
  public:
    explicit CurlClient(std::string base_url);
    ~CurlClient();
    CurlClient(const CurlClient&) = delete;
    CurlClient& operator=(const CurlClient&) = delete;

    // `headers` are whole lines, "Name: value".
    Reply request(const std::string& method,
                  const std::string& target,
                  const std::string& body = {},
                  const std::vector<std::string>& headers = {});
    Reply get(const std::string& target) { return request("GET", target); }
    Reply post(const std::string& target,
               const std::string& body,
               const std::string& content_type) {
        return request("POST", target, body, {"Content-Type: " + content_type});
    }

  private:
    struct Close {
        void operator()(void* handle) const;
    };
    std::string base_url_;
    std::unique_ptr<void, Close> handle_;
};

}  // namespace haarmony::testing
