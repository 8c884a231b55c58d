#include "ingest/confine.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <charconv>
#include <cstring>

namespace haarmony::ingest {
namespace {

bool limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
    const rlimit value = {soft, hard};
    return ::setrlimit(resource, &value) == 0;
}

}  // namespace

std::uint64_t address_space_argument(int argc, char** argv) {
    std::uint64_t bytes = 0;
    if (argc == 2) std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), bytes);
    return bytes;
}

bool confine(std::uint64_t address_space) {
    bool done = limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_FSIZE, 0, 0) &&
                ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    // Their shadow memory alone takes terabytes of addresses.
    static_cast<void>(address_space);
#else
    done = done && limit(RLIMIT_AS, address_space, address_space);
#endif
    return done;
}

bool allow_seconds(std::int64_t seconds) {
    rusage used{};
    if (::getrusage(RUSAGE_SELF, &used) != 0) return false;
    const auto spent =
        static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
    return limit(RLIMIT_CPU, spent + static_cast<rlim_t>(seconds), RLIM_INFINITY);
}

}  // namespace haarmony::ingest
