// The other process of the tests: schema_process COMMAND DATABASE.
//
//   open            waits for a line, opens the database, prints its version
//   add             opens, then commits batches of kBatch pictures, a line after each
//   transaction     opens, commits one batch, adds another without committing, waits
//   migrate N       applies migration N up to its version number, writes what is dirty to
//                   the file, and waits inside the transaction
//   stores          opens, then writes rounds of a job, feedback and a generation of
//                   duplicates, a line after each
//   exclusive       tries to take the file for itself; prints "free" or "in use"
#include <sqlite3.h>

#include <cstdio>
#include <iostream>
#include <string>

#include "schema/duplicate_store.h"
#include "schema/feedback_store.h"
#include "schema/job_store.h"
#include "schema/migrate.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"

namespace haarmony::schema {
namespace {

constexpr int kBatch = 20;

void say(const std::string& line) { std::cout << line << std::endl; }

void wait_for_line() {
    std::string line;
    std::getline(std::cin, line);
}

void open_once(const std::string& path) {
    say("ready");
    wait_for_line();
    const Database database = open_database(path);
    say(std::to_string(sql_integer(database.handle(), "PRAGMA user_version")));
}

Result<void> add_batch(ImageStore& store, int batch) {
    for (int i = 0; i < kBatch; ++i) {
        Result<ImageId> id = store.add(file_picture(batch * kBatch + i));
        if (!id) return std::move(id).error();
    }
    return {};
}

void add_batches(const std::string& path) {
    Database database = open_database(path);
    ImageStore store(database);
    for (int batch = 0;; ++batch) {
        expect(store.transaction([&] { return add_batch(store, batch); }));
        say(std::to_string(batch));
    }
}

void stay_in_transaction(const std::string& path) {
    Database database = open_database(path);
    ImageStore store(database);
    expect(store.transaction([&] { return add_batch(store, 0); }));
    expect(store.transaction([&] {
        Result<void> added = add_batch(store, 1);
        // A large transaction overflows the page cache into the log before it commits.
        sqlite3_db_cacheflush(database.handle());
        say("inside");
        wait_for_line();
        return added;
    }));
}

void stay_in_migration(const std::string& path, int version) {
    const RawConnection connection(path);
    sqlite3* database = connection.handle();
    expect(migrate(database, migrations().first(static_cast<std::size_t>(version) - 1)));
    if (version > 1) run_sql(database, "PRAGMA journal_mode = WAL");
    run_sql(database, "BEGIN EXCLUSIVE");
    if (version == 1) {
        run_sql(database, "PRAGMA application_id = " + std::to_string(kApplicationId));
    }
    run_sql(database, migrations()[static_cast<std::size_t>(version) - 1].sql);
    sqlite3_db_cacheflush(database);
    say("inside");
    wait_for_line();
}

// In round n: job n gets as far as n with n errors at most, and generation n has the pairs
// of pictures 1 and 2 and of 3 and 4, each of similarity n.
void write_rounds(const std::string& path) {
    Database database = open_database(path);
    ImageStore images(database);
    expect(images.transaction([&] { return add_batch(images, 0); }));
    JobStore jobs(database);
    FeedbackStore feedback(database);
    DuplicateStore duplicates(database);
    for (int round = 1;; ++round) {
        const std::vector<std::string> errors(3, std::to_string(round));
        const auto job = expect(jobs.create("round", "{}")).id;
        expect(jobs.start(job));
        expect(jobs.progress(
            job, {.seen = round, .added = round}, round, std::to_string(round), errors));
        NewFeedback drawn;
        drawn.kind = "painted";
        drawn.target = ImageId{1};
        drawn.strokes = "{}";
        expect(feedback.add(drawn));
        const auto generation = expect(duplicates.begin_generation());
        for (const int first : {1, 3}) {
            expect(
                duplicates.add(generation,
                               std::vector<DuplicatePair>{{ImageId{first},
                                                           ImageId{first + 1},
                                                           "near",
                                                           static_cast<double>(round)}}));
        }
        expect(duplicates.publish(generation));
        say(std::to_string(round));
    }
}

void take_for_itself(const std::string& path) {
    const RawConnection connection(path);
    // Leaving the write-ahead log takes a lock that no other connection may share.
    const int result = sqlite3_exec(
        connection.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
    say(result == SQLITE_OK ? "free" : "in use");
}

int run(int count, char** arguments) {
    if (count < 3) return 2;
    const std::string command = arguments[1];
    const std::string path = arguments[2];
    if (command == "open") {
        open_once(path);
    } else if (command == "add") {
        add_batches(path);
    } else if (command == "transaction") {
        stay_in_transaction(path);
    } else if (command == "migrate" && count == 4) {
        stay_in_migration(path, std::stoi(arguments[3]));
    } else if (command == "stores") {
        write_rounds(path);
    } else if (command == "exclusive") {
        take_for_itself(path);
    } else {
        return 2;
    }
    return 0;
}

}  // namespace
}  // namespace haarmony::schema

int main(int count, char** arguments) {
    try {
        return haarmony::schema::run(count, arguments);
    } catch (const std::exception& failure) {
        std::cerr << failure.what() << '\n';
        return 1;
    }
}
