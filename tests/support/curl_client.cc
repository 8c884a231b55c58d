#include "tests/support/curl_client.h"

#include <curl/curl.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace haarmony::testing {
namespace {

std::size_t append_body(const char* bytes,
                        std::size_t size,
                        std::size_t count,
                        void* reply) {
    static_cast<Reply*>(reply)->body.append(bytes, size * count);
    return size * count;
}

std::size_t read_header(const char* bytes,
                        std::size_t size,
                        std::size_t count,
                        void* reply) {
    const std::string line(bytes, size * count);
    const auto colon = line.find(':');
    if (colon != std::string::npos) {
        std::string name = line.substr(0, colon);
        std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
            return static_cast<char>(std::tolower(c));
        });
        const auto from = line.find_first_not_of(' ', colon + 1);
        const auto to = line.find_last_not_of("\r\n ");
        static_cast<Reply*>(reply)->headers[name] =
            from <= to ? line.substr(from, to - from + 1) : "";
    }
    return size * count;
}

}  // namespace

void CurlClient::Close::operator()(void* handle) const { curl_easy_cleanup(handle); }

CurlClient::CurlClient(std::string base_url)
    : base_url_(std::move(base_url)), handle_(curl_easy_init()) {}

CurlClient::~CurlClient() = default;

Reply CurlClient::request(const std::string& method,
                          const std::string& target,
                          const std::string& body,
                          const std::vector<std::string>& headers) {
    CURL* curl = handle_.get();
    curl_easy_reset(curl);
    Reply reply;
    const std::string url = base_url_ + target;
    curl_slist* lines = curl_slist_append(nullptr, "Expect:");
    for (const std::string& header : headers)
        lines = curl_slist_append(lines, header.c_str());
    curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
    curl_easy_setopt(curl, CURLOPT_CUSTOMREQUEST, method.c_str());
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, lines);
    curl_easy_setopt(curl, CURLOPT_NOPROXY, "*");
    curl_easy_setopt(curl, CURLOPT_TIMEOUT, 60L);
    curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, append_body);
    curl_easy_setopt(curl, CURLOPT_WRITEDATA, &reply);
    curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, read_header);
    curl_easy_setopt(curl, CURLOPT_HEADERDATA, &reply);
    if (method == "HEAD") curl_easy_setopt(curl, CURLOPT_NOBODY, 1L);
    if (!body.empty() || method == "POST") {
        curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body.data());
        curl_easy_setopt(
            curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
    }
    const CURLcode code = curl_easy_perform(curl);
    curl_slist_free_all(lines);
    if (code == CURLE_OK) {
        curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &reply.status);
    } else {
        reply.body = curl_easy_strerror(code);
    }
    return reply;
}

}  // namespace haarmony::testing
