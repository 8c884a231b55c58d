// Several processes at one database at the same moment.
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "schema/image_store.h"
#include "schema/migrate.h"
#include "tests/schema/child_process.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

constexpr int kProcesses = 6;

// Starts them, lets them all go at once, and expects each to have the current version.
void open_together(const std::string& path) {
    std::vector<std::unique_ptr<ChildProcess>> children;
    for (int i = 0; i < kProcesses; ++i) {
        children.push_back(
            std::make_unique<ChildProcess>(std::vector<std::string>{"open", path}));
    }
    for (auto& child : children) ASSERT_EQ(child->read_line(), "ready");
    for (auto& child : children) child->release();
    for (auto& child : children) {
        EXPECT_EQ(child->read_line(), std::to_string(current_version()));
        EXPECT_EQ(child->wait(), 0);
    }
    const Database database = open_database(path);
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
}

TEST(Processes, AllThatCreateTheSameFileSucceed) {
    const ScratchFolder folder;
    for (int round = 0; round < 5; ++round) {
        open_together(folder.file("new" + std::to_string(round) + ".db"));
    }
}

TEST(Processes, AllThatMigrateTheSameFileSucceed) {
    const ScratchFolder folder;
    for (int round = 0; round < 5; ++round) {
        const std::string path = folder.file("old" + std::to_string(round) + ".db");
        {
            const RawConnection old(path);
            expect(migrate(old.handle(), migrations().first(1)));
            // Half of them still have to leave the rollback journal as well.
            if (round % 2 == 0) run_sql(old.handle(), "PRAGMA journal_mode = WAL");
        }
        open_together(path);
    }
}

TEST(Processes, ThreadsOfOneProcessThatCreateTheSameFileSucceed) {
    const ScratchFolder folder;
    for (int round = 0; round < 5; ++round) {
        const std::string path = folder.file(std::to_string(round) + ".db");
        std::vector<std::string> failures(4);
        std::vector<std::thread> threads;
        for (std::string& failure : failures) {
            threads.emplace_back([&failure, &path] {
                const auto database =
                    Database::open(path, Database::Mode::kReadWriteCreate);
                if (!database) failure = database.error().message;
            });
        }
        for (std::thread& thread : threads) thread.join();
        for (const std::string& failure : failures) EXPECT_EQ(failure, "");
    }
}

// Reading the header through a descriptor of our own and closing it would drop the locks
// that every connection of this process holds on the file.
TEST(Processes, OpeningASecondConnectionKeepsTheLocksOfTheFirst) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    Database first = open_database(path);
    ImageStore store(first);
    expect(store.add(file_picture(1)));
    { const Database second = open_database(path); }
    {
        ChildProcess other({"exclusive", path});
        EXPECT_EQ(other.read_line(), "in use");
        EXPECT_EQ(other.wait(), 0);
    }
    expect(store.add(file_picture(2)));
    EXPECT_EQ(expect(store.counts()).indexed, 2);
}

TEST(Processes, AFileThatNobodyHasOpenCanBeTakenAlone) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    { const Database first = open_database(path); }
    ChildProcess other({"exclusive", path});
    EXPECT_EQ(other.read_line(), "free");
    EXPECT_EQ(other.wait(), 0);
}

}  // namespace
}  // namespace haarmony::schema
