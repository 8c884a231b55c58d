// Whether an internet address belongs to the public network: what a server may be asked to
// connect to by strangers.
//
// Shape   IPv4, IPv6, and IPv4 inside IPv6 (mapped, NAT64, 6to4), judged by what is inside.
// Errors  any other family is not public.
// Threads const-safe.
// Source  IANA special-purpose address registries (RFC 6890 and its successors).
#pragma once

#include <sys/socket.h>

namespace haarmony::ingest {

// Requires: `address` is as long as its family says.
[[nodiscard]] bool is_public_address(const sockaddr& address);

}  // namespace haarmony::ingest
