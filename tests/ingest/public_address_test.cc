#include "ingest/public_address.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/un.h>

#include <cstring>

namespace haarmony::ingest {
namespace {

bool is_public(const char* text) {
    sockaddr_storage storage{};
    auto* in4 = reinterpret_cast<sockaddr_in*>(&storage);
    auto* in6 = reinterpret_cast<sockaddr_in6*>(&storage);
    if (::inet_pton(AF_INET, text, &in4->sin_addr) == 1) {
        storage.ss_family = AF_INET;
    } else {
        EXPECT_EQ(::inet_pton(AF_INET6, text, &in6->sin6_addr), 1) << text;
        storage.ss_family = AF_INET6;
    }
    return is_public_address(reinterpret_cast<const sockaddr&>(storage));
}

TEST(PublicAddress, SpecialRangesAreRefusedAtBothEnds) {
    for (const char* text :
         {"0.0.0.0",       "0.255.255.255",   "10.0.0.0",        "10.255.255.255",
          "100.64.0.0",    "100.127.255.255", "127.0.0.1",       "127.255.255.255",
          "169.254.0.0",   "169.254.169.254", "172.16.0.0",      "172.31.255.255",
          "192.0.0.1",     "192.0.2.9",       "192.88.99.1",     "192.168.0.0",
          "192.168.255.9", "198.18.0.1",      "198.19.255.255",  "198.51.100.1",
          "203.0.113.255", "224.0.0.1",       "239.255.255.255", "255.255.255.255"}) {
        EXPECT_FALSE(is_public(text)) << text;
    }
}

TEST(PublicAddress, NeighboursOfSpecialRangesAreAllowed) {
    for (const char* text : {"1.1.1.1",
                             "9.255.255.255",
                             "11.0.0.0",
                             "100.63.255.255",
                             "100.128.0.0",
                             "126.255.255.255",
                             "128.0.0.0",
                             "169.253.255.255",
                             "172.15.255.1",
                             "172.32.0.0",
                             "192.167.1.1",
                             "192.169.0.0",
                             "198.17.0.1",
                             "198.20.0.0",
                             "223.255.255.255"}) {
        EXPECT_TRUE(is_public(text)) << text;
    }
}

TEST(PublicAddress, VersionSixIsGlobalUnicastOnly) {
    for (const char* text : {"::",
                             "::1",
                             "fe80::1",
                             "fec0::1",
                             "fc00::1",
                             "fdff::1",
                             "ff02::1",
                             "2001::1",
                             "2001:db8::1",
                             "3fff:0::1",
                             "64:ff9b:1::1",
                             "100::1"}) {
        EXPECT_FALSE(is_public(text)) << text;
    }
    for (const char* text : {"2606:4700:4700::1111", "2a00:1450::1", "2001:4860::8888"}) {
        EXPECT_TRUE(is_public(text)) << text;
    }
}

TEST(PublicAddress, VersionFourInsideVersionSixIsJudgedByWhatIsInside) {
    for (const char* text : {"::ffff:127.0.0.1",
                             "::ffff:10.0.0.1",
                             "64:ff9b::7f00:1",
                             "2002:7f00:1::",
                             "2002:a00:1::"}) {
        EXPECT_FALSE(is_public(text)) << text;
    }
    for (const char* text : {"::ffff:8.8.8.8", "64:ff9b::808:808", "2002:808:808::"}) {
        EXPECT_TRUE(is_public(text)) << text;
    }
}

TEST(PublicAddress, OtherFamiliesAreRefused) {
    sockaddr address{};
    address.sa_family = AF_UNIX;
    EXPECT_FALSE(is_public_address(address));
}

}  // namespace
}  // namespace haarmony::ingest
