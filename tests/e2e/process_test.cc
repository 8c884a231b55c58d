#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <csignal>

namespace haarmony::testing {
namespace {

constexpr std::chrono::seconds kBound{60};

TEST(Process, KeepsOutputAndErrorApartAndTellsTheExitCode) {
    const Finished finished = run({"/bin/sh", "-c", "echo out; echo err >&2; exit 7"});
    EXPECT_EQ(finished.exit_code, 7);
    EXPECT_EQ(finished.out, "out\n");
    EXPECT_EQ(finished.err, "err\n");
}

// A pipe holds 64 kB; a daemon that is asked a thousand times logs more.
TEST(Process, MayWriteMoreErrorsThanAPipeHoldsWhileNobodyReads) {
    Process process({"/bin/sh", "-c", "head -c 1000000 /dev/zero >&2; echo there"});
    EXPECT_EQ(process.read_line(kBound), "there");
    EXPECT_EQ(process.wait(kBound).err.size(), 1'000'000U);
}

TEST(Process, IsToldASignalAsItsExitCode) {
    Process process({"/bin/sh", "-c", "echo there; exec sleep 600"});
    EXPECT_EQ(process.read_line(kBound), "there");
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait(kBound).exit_code, 128 + SIGKILL);
}

}  // namespace
}  // namespace haarmony::testing
