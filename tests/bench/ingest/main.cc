// haarmony-bench-ingest: what ingest costs, part by part and against others, in one process.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "ingest/decode.h"
#include "tests/bench/ingest/contenders.h"
#include "tests/bench/ingest/kernels.h"
#include "tests/bench/ingest/large_jpeg.h"
#include "tests/bench/ingest/paired.h"
#include "tests/bench/ingest/run_ingest.h"
#include "tests/bench/ingest/vips_thumbnail.h"

namespace {

using namespace haarmony;

// Levels of 255: about what a compact camera adds in daylight.
constexpr double kGrain = 4.0;

struct Options {
    std::string folder;
    std::size_t most = std::numeric_limits<std::size_t>::max();
    std::size_t large = 20;
    int rounds = 5;
};

std::size_t total_bytes(const std::vector<bench::JpegFile>& files) {
    std::size_t bytes = 0;
    for (const bench::JpegFile& file : files) bytes += file.bytes.size();
    return bytes;
}

void compare(const std::string& title,
             const std::vector<bench::JpegFile>& files,
             int rounds) {
    std::printf("%s: %zu JPEGs, %.0f KiB each\n",
                title.c_str(),
                files.size(),
                static_cast<double>(total_bytes(files)) / 1024 /
                    static_cast<double>(files.size()));
    const auto against =
        bench::measure_in_turns(bench::contenders(files), files.size(), rounds);
    std::printf("%s", bench::to_text(against).c_str());
    const auto parts =
        bench::measure_in_turns(bench::stages(files), files.size(), rounds);
    std::printf("%s\n", bench::to_text(parts).c_str());
}

std::vector<bench::JpegFile> enlarge(const std::vector<bench::JpegFile>& files,
                                     std::size_t count,
                                     double grain) {
    ingest::Decoder decoder(ingest::DecodeLimits{});
    std::vector<bench::JpegFile> large;
    for (std::size_t i = 0; i < count; ++i) {
        const bench::JpegFile& file = files[i * files.size() / count];
        const auto picture = decoder.decode(file.bytes);
        if (!picture) bench::give_up(file.name + ": " + picture.error().message);
        large.push_back(
            {file.name,
             bench::large_jpeg(picture->view(), grain, static_cast<unsigned>(i + 1))});
    }
    return large;
}

void run(const Options& options) {
    if (!bench::start_vips()) std::printf("libvips: absent, its rows are left out\n");
    const auto files = bench::read_folder(options.folder, options.most);
    compare("pictures as they are", files, options.rounds);
    if (options.large > 0) {
        const std::size_t count = std::min(options.large, files.size());
        compare("4 megapixels, interpolated", enlarge(files, count, 0), options.rounds);
        compare(
            "4 megapixels, with grain", enlarge(files, count, kGrain), options.rounds);
    }

    const auto cells = bench::cells_of(files);
    std::printf(
        "kernels: %zu pictures, 3 channels\n%s\n",
        cells.size(),
        bench::to_text(bench::measure_in_turns(
                           bench::kernel_steps(cells), cells.size(), options.rounds))
            .c_str());

    const bench::IngestRun ingest = bench::run_ingest(options.folder);
    std::printf(
        "folder to database, one worker: %lld added, %lld failed, %.0f a second of the "
        "clock, %.0f a second of processor time\n",
        static_cast<long long>(ingest.added),
        static_cast<long long>(ingest.failed),
        static_cast<double>(ingest.added) / ingest.wall_seconds,
        static_cast<double>(ingest.added) / ingest.processor_seconds);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Measures ingest, part by part and against others, on a folder of JPEGs");
    app.option_defaults()->always_capture_default();
    app.add_option("FOLDER", options.folder, "JPEGs")->required();
    app.add_option("--rounds", options.rounds, "measured rounds")
        ->check(CLI::Range(1, 1000));
    app.add_option("--most", options.most, "pictures of the folder, spread over it")
        ->check(CLI::PositiveNumber);
    app.add_option(
        "--large", options.large, "pictures enlarged to 4 megapixels, 0 = none");
    CLI11_PARSE(app, argc, argv);
    // As haarmony-ingest does; it spares every contender the same.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
    run(options);
    return 0;
}
