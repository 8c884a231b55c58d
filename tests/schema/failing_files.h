// A file layer for SQLite that fails on demand: SQLite's own, registered as the default
// while this lives, with a countdown to the operation that goes wrong.
//
// Threads  one.
#pragma once

#include <functional>

namespace haarmony::schema {

class FailingFiles {
  public:
    FailingFiles();
    FailingFiles(const FailingFiles&) = delete;
    FailingFiles& operator=(const FailingFiles&) = delete;
    ~FailingFiles();

    // From the n-th (0 is the next) write, sync, truncation, opening or deletion of a file
    // on, all of them fail with `result_code`.
    void fail_from(int operation, int result_code);
    void never_fail();
    // Calls `act` once, when the lock of a file has been refused that many times.
    void when_lock_is_refused(int times, std::function<void()> act);
    // Whether the countdown came to its end since fail_from().
    [[nodiscard]] bool failed() const;
};

}  // namespace haarmony::schema
