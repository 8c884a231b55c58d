#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <atomic>
#include <map>
#include <random>
#include <thread>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Signatures = std::map<ImageId, std::vector<std::uint8_t>>;

Signatures searchable(ImageStore& store, std::int64_t* sequence = nullptr) {
    Signatures found;
    const auto last = expect(store.for_each_searchable([&](const SearchableImage& image) {
        found[image.id].assign(image.signature.begin(), image.signature.end());
    }));
    if (sequence != nullptr) *sequence = last;
    return found;
}

// What a daemon does with the sequence.
class Follower {
  public:
    explicit Follower(ImageStore& store) : store_(store) {
        known_ = searchable(store_, &sequence_);
    }
    // Takes at most `limit` changes; how many there were.
    int poll(int limit) {
        const auto changes = expect(store_.changes_after(sequence_, limit));
        for (const Change& change : changes) {
            EXPECT_GT(change.sequence, sequence_);
            sequence_ = change.sequence;
            if (change.signature.empty()) {
                known_.erase(change.id);
            } else {
                known_[change.id] = change.signature;
            }
        }
        return static_cast<int>(changes.size());
    }
    [[nodiscard]] const Signatures& known() const { return known_; }
    [[nodiscard]] std::int64_t sequence() const { return sequence_; }

  private:
    ImageStore& store_;
    Signatures known_;
    std::int64_t sequence_ = 0;
};

class ChangeSequence : public testing::Test {
  protected:
    // The ids of the changes after `sequence`, gone ones negative.
    [[nodiscard]] std::vector<std::int64_t> after(std::int64_t sequence,
                                                  int limit = 100) {
        std::vector<std::int64_t> ids;
        for (const Change& change : expect(store_.changes_after(sequence, limit))) {
            ids.push_back(change.signature.empty() ? -to_int(change.id)
                                                   : to_int(change.id));
        }
        return ids;
    }
    [[nodiscard]] std::int64_t last() {
        std::int64_t sequence = 0;
        searchable(store_, &sequence);
        return sequence;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
};

TEST_F(ChangeSequence, AnEmptyDatabaseStandsAtZero) {
    EXPECT_EQ(last(), 0);
    EXPECT_THAT(after(0), IsEmpty());
}

TEST_F(ChangeSequence, APictureAppearsOnceAtItsLastChange) {
    const ImageId a = expect(store_.add(file_picture(1)));
    const ImageId b = expect(store_.add(file_picture(2)));
    EXPECT_THAT(after(0), ElementsAre(to_int(a), to_int(b)));
    const auto before = last();
    expect(store_.update(a, file_picture(3)));
    EXPECT_THAT(after(0), ElementsAre(to_int(b), to_int(a)));
    EXPECT_THAT(after(before), ElementsAre(to_int(a)));
    EXPECT_EQ(expect(store_.changes_after(before, 1)).front().signature,
              file_picture(3).signature);
}

TEST_F(ChangeSequence, WhateverTakesAPictureAwayIsSeenAsGone) {
    const ImageId removed_upload = expect(store_.add(upload_picture(1)));
    const ImageId removed_file = expect(store_.add(file_picture(2)));
    const ImageId purged = expect(store_.add(file_picture(3)));
    const ImageId failed = expect(store_.add(file_picture(4)));
    const auto before = last();
    expect(store_.remove(removed_upload));
    expect(store_.remove(removed_file));
    expect(store_.purge(purged));
    EXPECT_EQ(expect(store_.mark_failed(file_picture(4).uri, {}, "cut")), failed);
    EXPECT_THAT(after(before), ElementsAre(-1, -2, -3, -4));
    expect(store_.update(failed, file_picture(4)));
    expect(store_.update(removed_file, file_picture(2)));
    EXPECT_THAT(after(before), ElementsAre(-1, -3, 4, 2));
}

TEST_F(ChangeSequence, WhatASearchCannotSeeIsNoChange) {
    const ImageId id = expect(store_.add(file_picture(1)));
    const auto before = last();
    expect(store_.touch(id, {9, 9, "other"}));
    expect(store_.mark_failed("file:///never-indexed", {}, "cut"));
    expect(store_.update(id, file_picture(1)));  // the same pixels
    EXPECT_THAT(after(before), IsEmpty());
    EXPECT_EQ(last(), before);
}

TEST_F(ChangeSequence, AWriterThatForgetsItIsRecordedByTheTriggers) {
    expect(store_.add(file_picture(1)));
    expect(store_.add(file_picture(2)));
    expect(store_.add(file_picture(3)));
    const auto before = last();
    const RawConnection other(folder_.file("x.db"));
    run_sql(other.handle(), "UPDATE images SET signature = x'01' WHERE id = 2");
    run_sql(other.handle(), "DELETE FROM images WHERE id = 1");
    run_sql(other.handle(), "UPDATE images SET width = 7 WHERE id = 3");
    EXPECT_THAT(after(before), ElementsAre(2, -1, 3));
}

TEST_F(ChangeSequence, LimitedStepsGiveTheSameAsOne) {
    for (int i = 0; i < 30; ++i) expect(store_.add(file_picture(i)));
    std::vector<std::int64_t> stepwise;
    std::int64_t sequence = 0;
    for (;;) {
        const auto changes = expect(store_.changes_after(sequence, 7));
        if (changes.empty()) break;
        for (const Change& change : changes) stepwise.push_back(to_int(change.id));
        sequence = changes.back().sequence;
    }
    EXPECT_EQ(stepwise, after(0));
    EXPECT_EQ(sequence, last());
}

TEST_F(ChangeSequence, TheScanBelongsToExactlyItsSequenceNumber) {
    for (int i = 0; i < 5; ++i) expect(store_.add(file_picture(i)));
    const auto before = last();
    Database second = open_database(folder_.file("x.db"));
    ImageStore writer(second);
    bool wrote = false;
    Signatures seen;
    // Another connection commits while the scan stands on its first row.
    const auto sequence =
        expect(store_.for_each_searchable([&](const SearchableImage& image) {
            if (!wrote) {
                wrote = true;
                expect(writer.add(file_picture(77)));
                expect(writer.remove(ImageId{5}));
            }
            seen[image.id].assign(image.signature.begin(), image.signature.end());
        }));
    EXPECT_EQ(sequence, before);
    EXPECT_EQ(seen.size(), 5u);
    EXPECT_TRUE(seen.contains(ImageId{5}));
    EXPECT_THAT(after(sequence), ElementsAre(6, -5));
}

TEST_F(ChangeSequence, TheScanReadsInsideATransactionToo) {
    expect(store_.transaction([&]() -> Result<void> {
        expect(store_.add(file_picture(1)));
        std::int64_t sequence = 0;
        EXPECT_EQ(searchable(store_, &sequence).size(), 1u);
        EXPECT_EQ(sequence, 1);
        return {};
    }));
    EXPECT_EQ(searchable(store_).size(), 1u);
}

// The reason why no number is ever missed: a second writer gets no number before the first
// one's are visible.
TEST_F(ChangeSequence, NumbersAreHandedOutInTheOrderOfCommits) {
    Database second = open_database(folder_.file("x.db"));
    ImageStore other(second);
    sqlite3_busy_timeout(second.handle(), 1);
    Database third = open_database(folder_.file("x.db"));
    ImageStore reader(third);
    Follower follower(reader);

    expect(store_.transaction([&]() -> Result<void> {
        expect(store_.add(file_picture(1)));
        EXPECT_EQ(follower.poll(10), 0);
        EXPECT_EQ(other.add(file_picture(2)).error().code, ErrorCode::kUnavailable);
        return {};
    }));
    expect(other.add(file_picture(2)));
    EXPECT_EQ(follower.poll(1), 1);
    EXPECT_TRUE(follower.known().contains(ImageId{1}));
    EXPECT_EQ(follower.poll(10), 1);
    EXPECT_EQ(follower.known(), searchable(reader));
}

TEST_F(ChangeSequence, ANumberThatWasSeenIsNeverHandedOutAgain) {
    for (int i = 0; i < 3; ++i) expect(store_.add(file_picture(i)));
    const auto seen = last();
    expect(store_.purge(ImageId{3}));
    const auto rolled_back = store_.transaction([&]() -> Result<void> {
        for (int i = 10; i < 20; ++i) expect(store_.add(file_picture(i)));
        return Error{ErrorCode::kConflict, "no"};
    });
    EXPECT_FALSE(rolled_back);
    EXPECT_THAT(after(seen), ElementsAre(-3));
    const auto then = last();
    EXPECT_GT(then, seen);
    expect(store_.add(file_picture(30)));
    EXPECT_GT(last(), then);
}

// Two writers on connections of their own, who add, change, remove and roll back at random,
// and a third connection that follows in small steps all the while.
TEST_F(ChangeSequence, AFollowerOfTwoWritersEndsWithWhatTheTableHolds) {
    constexpr int kRounds = 150;
    std::atomic<int> running = 2;
    const auto write = [&](int writer) {
        Database database = open_database(folder_.file("x.db"));
        ImageStore store(database);
        std::mt19937 random(static_cast<unsigned>(writer));
        std::vector<ImageId> mine;
        for (int round = 0; round < kRounds; ++round) {
            const bool keep = random() % 4 != 0;
            std::vector<ImageId> added;
            const auto done = store.transaction([&]() -> Result<void> {
                for (unsigned step = random() % 4 + 1; step > 0; --step) {
                    const int number =
                        writer * 1'000'000 + static_cast<int>(random() % 100'000);
                    const ImageId one =
                        mine.empty() ? ImageId{} : mine[random() % mine.size()];
                    switch (mine.empty() ? 0 : random() % 4) {
                        case 1:
                            expect(store.update(one, upload_picture(number)));
                            break;
                        case 2:
                            // Removed before, perhaps: nothing to do then.
                            static_cast<void>(store.remove(one));
                            break;
                        default: {
                            NewImage image = upload_picture(number);
                            image.origin = ImageOrigin::kFile;
                            image.uri = std::to_string(writer) + "/" +
                                        std::to_string(round) + "/" +
                                        std::to_string(step);
                            added.push_back(expect(store.add(image)));
                        }
                    }
                }
                if (!keep) return Error{ErrorCode::kConflict, "no"};
                return {};
            });
            EXPECT_EQ(done.has_value(), keep);
            if (keep) mine.insert(mine.end(), added.begin(), added.end());
        }
    };

    // An exception must not leave a thread: it becomes a failure of the test.
    const auto guarded = [&](int writer) {
        try {
            write(writer);
        } catch (const std::exception& failure) {
            ADD_FAILURE() << failure.what();
        }
        --running;
    };
    std::thread first(guarded, 1);
    std::thread second(guarded, 2);
    Follower follower(store_);
    std::int64_t version = -1;
    while (running > 0) {
        const auto now = expect(database_.data_version());
        if (now == version) continue;
        version = now;
        while (follower.poll(3) == 3) {
        }
    }
    first.join();
    second.join();
    while (follower.poll(3) == 3) {
    }
    EXPECT_EQ(follower.known(), searchable(store_));
    EXPECT_EQ(follower.sequence(), last());
    EXPECT_FALSE(follower.known().empty());
}

TEST_F(ChangeSequence, PollingReadsTheEndOfTheSequenceOnly) {
    expect(store_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 2000; ++i) expect(store_.add(file_picture(i)));
        return {};
    }));
    const auto sequence = last();
    EXPECT_THAT(after(sequence - 1), ElementsAre(2000));
    sqlite3_stmt* statement = nullptr;
    int steps = 0;
    while ((statement = sqlite3_next_stmt(database_.handle(), statement)) != nullptr) {
        if (std::string_view(sqlite3_sql(statement)).find("changes.seq >") !=
            std::string_view::npos) {
            steps = sqlite3_stmt_status(statement, SQLITE_STMTSTATUS_VM_STEP, 0);
        }
    }
    EXPECT_GT(steps, 0);
    EXPECT_LT(steps, 100);
}

}  // namespace
}  // namespace haarmony::schema
