#include "ingest/gallery/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>
#include <thread>
#include <vector>

#include "ingest/gallery/export.h"
#include "ingest/gallery/gallery.h"

namespace haarmony::gallery {
namespace {

constexpr int kUsage = 2;
constexpr int kCouldNotRun = 3;

}  // namespace

int run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
    ExportOptions options;
    options.jobs =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostJobs);
    std::string folder;
    CLI::App app("Paints a gallery of pictures, the same for the same seed.",
                 "haarmony-gallery");
    app.add_option("--out", folder, "Folder for the pictures; made when absent")
        ->required()
        ->type_name("DIR");
    app.add_option("--count", options.count, "How many pictures")
        ->check(CLI::Range(1, kMostPictures))
        ->capture_default_str();
    // Without the check a negative number would wrap to a large seed.
    app.add_option("--seed", options.seed, "Another seed, other pictures")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--jobs", options.jobs, "How many are painted at a time")
        ->check(CLI::Range(1, kMostJobs))
        ->capture_default_str();
    app.add_option("--side", options.side, "Longest side in pixels [640 to 800]")
        ->check(CLI::Range(kLeastSide, kLargestSide));
    // CLI11 takes the words from the back.
    std::vector<std::string> words(arguments.rbegin(), arguments.rend());
    try {
        app.parse(words);
        if (folder.empty())
            throw CLI::ValidationError("--out", "the folder is an empty name");
    } catch (const CLI::ParseError& error) {
        return app.exit(error, out, err) == 0 ? 0 : kUsage;
    }
    options.folder = folder;
    const Result<ExportReport> report = export_gallery(options);
    if (!report) {
        err << "haarmony-gallery: " << report.error().message << '\n';
        return kCouldNotRun;
    }
    out << "wrote " << report->written << " pictures to " << folder;
    if (report->unchanged > 0) out << " (" << report->unchanged << " were there already)";
    out << '\n';
    return 0;
}

}  // namespace haarmony::gallery
