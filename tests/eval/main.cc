// haarmony-eval: measures how well and how fast the search works on one's own pictures.
#include <CLI/CLI.hpp>
#include <iostream>

#include "tests/eval/copies.h"

int main(int argc, char** argv) {
    CLI::App app{"Measures how well the search works on a folder of pictures"};
    app.require_subcommand(1);
    haarmony::eval::CopiesOptions options;
    CLI::App* copies = app.add_subcommand(
        "copies", "ranks of the originals of poor copies and of coarse paintings");
    copies->add_option("--images", options.folder, "folder of pictures")->required();
    copies->add_option("--queries", options.queries, "how many pictures to query for")
        ->check(CLI::Range(1, 1'000'000));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const auto report = haarmony::eval::measure_copies(options);
    if (!report) {
        std::cerr << report.error().message << '\n';
        return 3;
    }
    std::cout << to_text(*report);
    return 0;
}
