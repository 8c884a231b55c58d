#include "tests/eval/memory_bandwidth.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "tests/eval/cpu_clock.h"
#include "tests/eval/vector_clones.h"

namespace haarmony::eval {
namespace {

[[gnu::always_inline]] inline std::uint64_t sum_of(const std::uint64_t* words,
                                                   std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += words[i];
    return sum;
}

HAARMONY_EVAL_AVX2 std::uint64_t sum_avx2(const std::uint64_t* words, std::size_t count) {
    return sum_of(words, count);
}

std::uint64_t sum_any(const std::uint64_t* words, std::size_t count) {
    return sum_of(words, count);
}

}  // namespace

double memory_bandwidth(std::size_t bytes, int passes) {
    assert(bytes >= 4096 && passes >= 1);
    const auto sum = has_avx2() ? sum_avx2 : sum_any;
    const std::vector<std::uint64_t> words(bytes / sizeof(std::uint64_t), 1);
    double best = 0;
    for (int pass = 0; pass < passes; ++pass) {
        const double start = thread_cpu_ms();
        // Volatile: the sum is the point, not its value.
        [[maybe_unused]] const volatile std::uint64_t total =
            sum(words.data(), words.size());
        const double elapsed_ms = thread_cpu_ms() - start;
        best =
            std::max(best, static_cast<double>(bytes) / std::max(elapsed_ms, 1e-3) * 1e3);
    }
    return best;
}

}  // namespace haarmony::eval
