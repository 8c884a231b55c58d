#include "schema/snapshot_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <vector>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

TEST(Snapshots, AreFoundByTheirTokens) {
    const ScratchFolder folder;
    Database database = open_database(folder.file("x.db"));
    SnapshotStore store(database);
    EXPECT_EQ(expect(store.find({})), std::nullopt);
    const SnapshotToken first = expect(store.add(0));
    const SnapshotToken second = expect(store.add(17));
    EXPECT_NE(first, second);
    EXPECT_EQ(expect(store.find(first)), 0);
    EXPECT_EQ(expect(store.find(second)), 17);
    SnapshotToken unknown = second;
    unknown[15] ^= 1;
    EXPECT_EQ(expect(store.find(unknown)), std::nullopt);
}

TEST(Snapshots, OnlyTheLastAreKnown) {
    const ScratchFolder folder;
    Database database = open_database(folder.file("x.db"));
    SnapshotStore store(database);
    std::vector<SnapshotToken> tokens;
    for (int i = 0; i < SnapshotStore::kMostKnown + 3; ++i)
        tokens.push_back(expect(store.add(i)));
    EXPECT_EQ(std::set(tokens.begin(), tokens.end()).size(), tokens.size());
    for (int i = 0; i < int(tokens.size()); ++i)
        EXPECT_EQ(expect(store.find(tokens[std::size_t(i)])).has_value(), i >= 3) << i;
}

// The reason for tokens: numbers are given again after an older copy was put back.
TEST(Snapshots, AnOlderCopyOfTheDatabaseDoesNotKnowWhatCameAfterIt) {
    const ScratchFolder folder;
    SnapshotToken before{};
    {
        Database database = open_database(folder.file("x.db"));
        before = expect(SnapshotStore(database).add(5));
    }
    std::filesystem::copy_file(folder.file("x.db"), folder.file("copy.db"));
    Database database = open_database(folder.file("x.db"));
    const SnapshotToken after = expect(SnapshotStore(database).add(5));
    Database copy = open_database(folder.file("copy.db"));
    SnapshotStore store(copy);
    EXPECT_EQ(expect(store.find(before)), 5);
    EXPECT_EQ(expect(store.find(after)), std::nullopt);
    EXPECT_NE(expect(store.add(5)), after);
}

TEST(Snapshots, ATableThatIsGoneIsAnErrorThatSaysWhatWasWanted) {
    const ScratchFolder folder;
    Database database = open_database(folder.file("x.db"));
    SnapshotStore store(database);
    run_sql(database.handle(), "DROP TABLE snapshots");
    const auto added = store.add(1);
    ASSERT_FALSE(added);
    EXPECT_NE(added.error().message.find("cannot note a snapshot"), std::string::npos);
    const auto found = store.find({});
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("cannot look for a snapshot"),
              std::string::npos);
}

}  // namespace
}  // namespace haarmony::schema
