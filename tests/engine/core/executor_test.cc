#include "engine/core/executor.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony {
namespace {

TEST(InlineExecutor, CallsEveryIndexOnceAndInOrder) {
    InlineExecutor executor;
    std::vector<std::size_t> calls;
    executor.parallel_for(4, [&](std::size_t i) { calls.push_back(i); });
    EXPECT_EQ(calls, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(InlineExecutor, OfNothingCallsNothing) {
    InlineExecutor executor;
    executor.parallel_for(0, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace haarmony
