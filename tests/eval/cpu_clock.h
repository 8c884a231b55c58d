// The time that the calling thread has run: what others do on the machine does not count,
// though their use of caches and memory does.
//
// Units   milliseconds. Cost: under a microsecond.
#pragma once

#include <ctime>
#include <functional>

namespace haarmony::eval {

[[nodiscard]] inline double thread_cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 +
           static_cast<double>(now.tv_nsec) * 1e-6;
}

// How long `work` runs.
[[nodiscard]] inline double cpu_ms_of(const std::function<void()>& work) {
    const double begin = thread_cpu_ms();
    work();
    return thread_cpu_ms() - begin;
}

}  // namespace haarmony::eval
