// Writes readings in batches, one transaction each (ingest, step 4 of 4):
//   walk -> decode -> describe -> [store]
//
// Errors  those of the catalogue. The batch at fault is not written at all; earlier ones
//         stay, and only they are counted and reported.
// Threads one thread.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "ingest/batch.h"
#include "ingest/catalogue.h"
#include "ingest/tally.h"

namespace haarmony::ingest {

// Who hears of a run while it goes on, on the thread that called run().
class Observer {
  public:
    virtual ~Observer() = default;
    virtual void failed(const std::string& path, const std::string& reason) = 0;
    // Often; `total` is the number of candidates, -1 while they are still being counted.
    virtual void progress(const Tally& tally, std::int64_t total) = 0;
};

class Writer {
  public:
    Writer(Catalogue& catalogue, Observer& observer, bool restore)
        : catalogue_(catalogue), observer_(observer), restore_(restore) {}

    // Writes when the batch is full or has waited long enough.
    [[nodiscard]] Result<void> take(FileReading reading, Batch::TimePoint now);
    [[nodiscard]] Result<void> write_if_due(Batch::TimePoint now);
    [[nodiscard]] Result<void> write();

    // Nothing to write; only to be counted.
    void count_unchanged();
    void report_failure(const std::string& path, const std::string& reason);
    void count_pruned(std::int64_t rows) { tally_.pruned += rows; }

    [[nodiscard]] const Batch& batch() const { return batch_; }
    [[nodiscard]] const Tally& tally() const { return tally_; }

  private:
    // What is to be counted of it.
    [[nodiscard]] Result<Tally> write_one(const FileReading& reading);
    [[nodiscard]] Result<Tally> write_picture(const FileReading& reading);

    Catalogue& catalogue_;
    Observer& observer_;
    const bool restore_;
    Batch batch_;
    Tally tally_;
};

}  // namespace haarmony::ingest
