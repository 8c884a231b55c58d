#include "ingest/public_address.h"

#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace haarmony::ingest {
namespace {

struct Prefix4 {
    std::uint32_t address;
    int bits;
};

constexpr std::uint32_t dotted(unsigned a, unsigned b, unsigned c, unsigned d) {
    return a << 24 | b << 16 | c << 8 | d;
}

constexpr std::array kSpecial4 = {
    Prefix4{dotted(0, 0, 0, 0), 8},        // this network
    Prefix4{dotted(10, 0, 0, 0), 8},       // private
    Prefix4{dotted(100, 64, 0, 0), 10},    // shared, behind a provider's translation
    Prefix4{dotted(127, 0, 0, 0), 8},      // loopback
    Prefix4{dotted(169, 254, 0, 0), 16},   // link-local; cloud metadata lives here
    Prefix4{dotted(172, 16, 0, 0), 12},    // private
    Prefix4{dotted(192, 0, 0, 0), 24},     // protocol assignments
    Prefix4{dotted(192, 0, 2, 0), 24},     // documentation
    Prefix4{dotted(192, 88, 99, 0), 24},   // 6to4 relays
    Prefix4{dotted(192, 168, 0, 0), 16},   // private
    Prefix4{dotted(198, 18, 0, 0), 15},    // benchmarks
    Prefix4{dotted(198, 51, 100, 0), 24},  // documentation
    Prefix4{dotted(203, 0, 113, 0), 24},   // documentation
    Prefix4{dotted(224, 0, 0, 0), 4},      // multicast
    Prefix4{dotted(240, 0, 0, 0), 4},      // reserved, broadcast
};

bool is_public4(std::uint32_t address) {
    return std::none_of(kSpecial4.begin(), kSpecial4.end(), [&](const Prefix4& prefix) {
        return (address ^ prefix.address) >> (32 - prefix.bits) == 0;
    });
}

using Bytes6 = std::array<std::uint8_t, 16>;

bool begins(const Bytes6& address, std::initializer_list<std::uint8_t> prefix) {
    return std::equal(prefix.begin(), prefix.end(), address.begin());
}

bool is_public4_at(const Bytes6& address, std::size_t at) {
    return is_public4(
        dotted(address[at], address[at + 1], address[at + 2], address[at + 3]));
}

bool is_public6(const Bytes6& address) {
    if (begins(address, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff})) {
        return is_public4_at(address, 12);  // IPv4-mapped
    }
    if (begins(address, {0, 0x64, 0xff, 0x9b, 0, 0, 0, 0, 0, 0, 0, 0})) {
        return is_public4_at(address, 12);  // NAT64
    }
    if (begins(address, {0x20, 0x02})) return is_public4_at(address, 2);  // 6to4
    // Outside global unicast (2000::/3) lie loopback, link-local, private and multicast.
    if ((address[0] & 0xe0) != 0x20) return false;
    const bool protocols =
        begins(address, {0x20, 0x01}) && address[2] < 0x02;  // 2001::/23
    const bool documentation = begins(address, {0x20, 0x01, 0x0d, 0xb8}) ||
                               (begins(address, {0x3f, 0xff}) && address[2] < 0x10);
    return !protocols && !documentation;
}

}  // namespace

bool is_public_address(const sockaddr& address) {
    if (address.sa_family == AF_INET) {
        sockaddr_in in4{};
        std::memcpy(&in4, &address, sizeof(in4));
        return is_public4(ntohl(in4.sin_addr.s_addr));
    }
    if (address.sa_family == AF_INET6) {
        sockaddr_in6 in6{};
        std::memcpy(&in6, &address, sizeof(in6));
        Bytes6 bytes{};
        std::memcpy(bytes.data(), &in6.sin6_addr, bytes.size());
        return is_public6(bytes);
    }
    return false;
}

}  // namespace haarmony::ingest
