#include "server/http/request_id.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <random>

namespace haarmony::http {
namespace {

constexpr std::size_t kLongest = 128;

std::uint64_t random_start() {
    std::random_device device;
    return (static_cast<std::uint64_t>(device()) << 32U) | device();
}

}  // namespace

bool is_request_id(std::string_view text) {
    return !text.empty() && text.size() <= kLongest &&
           std::all_of(
               text.begin(), text.end(), [](char c) { return c > ' ' && c < '\x7f'; });
}

std::string make_request_id() {
    // An odd step through 2^64 values comes back to its start only after all of them.
    static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15;
    static std::atomic<std::uint64_t> next{random_start()};
    static constexpr std::string_view kHex = "0123456789abcdef";
    std::uint64_t value = next.fetch_add(kStep, std::memory_order_relaxed);
    std::string id(16, '0');
    for (char& c : id) {
        c = kHex[value & 15U];
        value >>= 4U;
    }
    return id;
}

}  // namespace haarmony::http
