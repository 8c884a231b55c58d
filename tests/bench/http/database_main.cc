// haarmony-bench-database: a database with as many pictures as a measurement needs.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "tests/bench/http/cached_rows.h"
#include "tests/bench/http/synthetic_rows.h"

namespace {

using namespace haarmony;

struct Options {
    std::string database;
    std::string signatures;  // a cache; empty for noise
    std::int64_t images = 20'000;
    unsigned seed = 1;
};

Result<void> write(const Options& options) {
    if (options.signatures.empty()) {
        return bench::write_rows(options.database, options.images, [&](std::int64_t n) {
            return bench::synthetic_signature(options.seed, n);
        });
    }
    return bench::write_cached_rows(options.database, options.images, options.signatures);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Writes rows with synthetic signatures into a Haarmony database.");
    app.add_option("--db", options.database, "the database; created where it is absent")
        ->required();
    app.add_option("--images", options.images, "rows to add")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    auto* const seed =
        app.add_option("--seed", options.seed, "of signatures without any likeness")
            ->capture_default_str();
    app.add_option("--signatures",
                   options.signatures,
                   "those of pictures instead: a file of haarmony-eval speed --cache")
        ->excludes(seed);
    CLI11_PARSE(app, argc, argv);

    const Result<void> written = write(options);
    if (written) return 0;
    std::cerr << "haarmony-bench-database: " << written.error().message << '\n';
    return 1;
}
