#include "ingest/fetch.h"

#include <curl/curl.h>
#include <sys/socket.h>

#include <array>
#include <memory>

#include "ingest/one_line.h"
#include "ingest/public_address.h"

namespace haarmony::ingest {
namespace {

// One transfer, as the callbacks see it.
struct Transfer {
    const FetchOptions& options;
    std::vector<std::uint8_t> bytes;
    bool too_large = false;
    bool forbidden = false;
};

std::size_t on_bytes(char* bytes, std::size_t size, std::size_t count, void* context) {
    Transfer& transfer = *static_cast<Transfer*>(context);
    const std::size_t length = size * count;
    const std::size_t limit = static_cast<std::size_t>(transfer.options.max_bytes);
    if (length > limit - transfer.bytes.size()) {
        transfer.too_large = true;
        return CURL_WRITEFUNC_ERROR;
    }
    transfer.bytes.insert(transfer.bytes.end(), bytes, bytes + length);
    return length;
}

curl_socket_t open_socket(void* context, curlsocktype, curl_sockaddr* address) {
    Transfer& transfer = *static_cast<Transfer*>(context);
    if (!transfer.options.allow_private_addresses && !is_public_address(address->addr)) {
        transfer.forbidden = true;
        return CURL_SOCKET_BAD;
    }
    return ::socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
}

struct CloseHandle {
    void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
};
using Handle = std::unique_ptr<CURL, CloseHandle>;

bool prepare_library() {
    static const bool ready = curl_global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK;
    return ready;
}

void configure(CURL* handle, const std::string& url, Transfer& transfer, char* message) {
    const FetchOptions& options = transfer.options;
    curl_easy_setopt(handle, CURLOPT_URL, url.c_str());
    curl_easy_setopt(handle, CURLOPT_ERRORBUFFER, message);
    curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(handle, CURLOPT_REDIR_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(handle, CURLOPT_DISALLOW_USERNAME_IN_URL, 1L);
    curl_easy_setopt(handle, CURLOPT_FOLLOWLOCATION, 1L);
    curl_easy_setopt(handle, CURLOPT_MAXREDIRS, static_cast<long>(options.max_redirects));
    curl_easy_setopt(handle, CURLOPT_PROXY, "");
    curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(handle, CURLOPT_FAILONERROR, 1L);
    curl_easy_setopt(handle, CURLOPT_USERAGENT, "haarmony");
    curl_easy_setopt(
        handle, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(options.connect.count()));
    curl_easy_setopt(
        handle, CURLOPT_TIMEOUT_MS, static_cast<long>(options.total.count()));
    curl_easy_setopt(
        handle, CURLOPT_MAXFILESIZE_LARGE, static_cast<curl_off_t>(options.max_bytes));
    curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, &on_bytes);
    curl_easy_setopt(handle, CURLOPT_WRITEDATA, &transfer);
    curl_easy_setopt(handle, CURLOPT_OPENSOCKETFUNCTION, &open_socket);
    curl_easy_setopt(handle, CURLOPT_OPENSOCKETDATA, &transfer);
}

Error describe_failure(CURL* handle,
                       CURLcode code,
                       const Transfer& transfer,
                       const std::string& message) {
    const std::string reason = message.empty() ? curl_easy_strerror(code) : message;
    if (transfer.forbidden) {
        return {ErrorCode::kForbidden, "the address does not lead to the public network"};
    }
    if (transfer.too_large || code == CURLE_FILESIZE_EXCEEDED) {
        return {ErrorCode::kTooLarge,
                "the file is larger than " + std::to_string(transfer.options.max_bytes) +
                    " bytes"};
    }
    long status = 0;
    long connections = 0;
    curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
    curl_easy_getinfo(handle, CURLINFO_NUM_CONNECTS, &connections);
    // The same code tells of a server that speaks something else than HTTP.
    const bool wrong_scheme =
        code == CURLE_UNSUPPORTED_PROTOCOL && (connections == 0 || status != 0);
    if (wrong_scheme || code == CURLE_URL_MALFORMAT || code == CURLE_LOGIN_DENIED) {
        return {ErrorCode::kInvalidArgument,
                "not an address that can be fetched: " + one_line(reason)};
    }
    if (code == CURLE_HTTP_RETURNED_ERROR) {
        const bool gone = status == 404 || status == 410;
        return {gone ? ErrorCode::kNotFound : ErrorCode::kUnavailable,
                "the server answered with status " + std::to_string(status)};
    }
    return {ErrorCode::kUnavailable, "the address cannot be read: " + one_line(reason)};
}

}  // namespace

Result<std::vector<std::uint8_t>> fetch(const std::string& url,
                                        const FetchOptions& options) {
    const Error no_client = {ErrorCode::kUnavailable,
                             "the HTTP client cannot be started"};
    if (!prepare_library()) return no_client;
    const Handle handle(curl_easy_init());
    if (!handle) return no_client;
    Transfer transfer{options, {}, false, false};
    std::array<char, CURL_ERROR_SIZE> message{};
    configure(handle.get(), url, transfer, message.data());
    const CURLcode code = curl_easy_perform(handle.get());
    if (code == CURLE_OK) return std::move(transfer.bytes);
    return describe_failure(handle.get(), code, transfer, message.data());
}

}  // namespace haarmony::ingest
