// haarmony-bench-database: a database with as many pictures as a measurement needs.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "tests/bench/http/synthetic_rows.h"

int main(int argc, char** argv) {
    std::string database;
    std::int64_t images = 20'000;
    unsigned seed = 1;
    CLI::App app("Writes rows with synthetic signatures into a Haarmony database.");
    app.add_option("--db", database, "the database; created where it is absent")
        ->required();
    app.add_option("--images", images, "rows to add")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--seed", seed, "of the signatures")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    const haarmony::Result<void> written =
        haarmony::bench::write_rows(database, images, seed);
    if (written) return 0;
    std::cerr << "haarmony-bench-database: " << written.error().message << '\n';
    return 1;
}
