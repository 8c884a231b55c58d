#include "tests/eval/copies.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "engine/image/index.h"
#include "engine/image/profile.h"
#include "engine/image/signature_codec.h"
#include "ingest/describe.h"
#include "tests/eval/degrade.h"

namespace haarmony::eval {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<std::uint8_t> read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct QueryKind {
    std::string name;
    std::string profile;
    std::function<RgbPicture(const RgbPicture&)> degrade;
};

const std::vector<QueryKind>& query_kinds() {
    static const std::vector<QueryKind> kinds = {
        {"original", "scanned", [](const RgbPicture& p) { return p; }},
        {"48 px, dark, blurred", "scanned", poor_copy},
        {"48 px, dark, blurred", "painted", poor_copy},
        {"8x8 mosaic", "painted", [](const RgbPicture& p) { return mosaic(p, 8); }},
        {"8x8 painted",
         "painted",
         [](const RgbPicture& p) { return painted_mosaic(p, 8); }},
    };
    return kinds;
}

struct Target {
    ImageId id{};
    std::string path;
};

CopiesRow measure(const QueryKind& kind,
                  const std::vector<Target>& targets,
                  const image::IndexSnapshot& snapshot,
                  std::int64_t pictures) {
    const image::Profile profile = *image::built_in_profile(kind.profile);
    CopiesRow row{kind.name, kind.profile, {}, 0};
    std::vector<double> times;
    ingest::Decoder decoder{ingest::DecodeLimits{}};
    for (const Target& target : targets) {
        const Result<ingest::Picture> picture = decoder.decode(read_bytes(target.path));
        if (!picture)
            continue;  // it was read a moment ago; a changed folder costs a query
        const RgbPicture degraded = kind.degrade(to_rgb(picture->view()));
        const image::Query query =
            image::make_query(image::make_signature(degraded.view()), profile, profile.m);
        const auto start = Clock::now();
        (void)snapshot.search(query, {20});
        times.push_back(seconds_since(start) * 1000);
        const auto all = snapshot.search(query, {static_cast<int>(pictures)}).matches;
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const image::Match& m) {
                return m.id == target.id;
            });
        row.ranks.push_back(found - all.begin() + 1);
    }
    std::sort(times.begin(), times.end());
    if (!times.empty()) row.median_query_ms = times[times.size() / 2];
    return row;
}

}  // namespace

Result<CopiesReport> measure_copies(const CopiesOptions& options) {
    std::error_code failure;
    std::vector<std::string> paths;
    for (fs::recursive_directory_iterator it(options.folder, failure), end;
         !failure && it != end;
         it.increment(failure)) {
        if (it->is_regular_file()) paths.push_back(it->path().string());
    }
    if (failure)
        return Error{ErrorCode::kNotFound, options.folder + ": " + failure.message()};
    std::sort(paths.begin(), paths.end());

    CopiesReport report;
    ingest::Decoder decoder{ingest::DecodeLimits{}};
    std::vector<image::Record> records;
    std::vector<Target> read;
    const auto start = Clock::now();
    for (const std::string& path : paths) {
        const Result<schema::NewImage> described =
            ingest::describe(decoder, read_bytes(path), ingest::kMainKind);
        if (!described) {
            report.unreadable.push_back(path + ": " + described.error().message);
            continue;
        }
        const ImageId id{static_cast<std::int64_t>(records.size()) + 1};
        records.push_back({id, image::decode_signature(described->signature).value()});
        read.push_back({id, path});
    }
    if (records.empty()) {
        return Error{ErrorCode::kNotFound,
                     options.folder + ": no picture that can be read"};
    }
    report.pictures = static_cast<std::int64_t>(records.size());
    report.describe_per_second = static_cast<double>(paths.size()) / seconds_since(start);

    image::Index index{image::IndexOptions{}};
    index.apply(records, {});
    const auto snapshot = index.snapshot();

    const auto count = std::min<std::size_t>(options.queries, read.size());
    std::vector<Target> targets;
    for (std::size_t i = 0; i < count; ++i)
        targets.push_back(read[i * read.size() / count]);
    for (const Target& target : targets) report.targets.push_back(target.path);
    for (const QueryKind& kind : query_kinds()) {
        report.rows.push_back(measure(kind, targets, *snapshot, report.pictures));
    }
    return report;
}

std::string to_text(const CopiesReport& report) {
    std::ostringstream text;
    text << report.pictures << " pictures, " << report.unreadable.size()
         << " unreadable, " << static_cast<std::int64_t>(report.describe_per_second)
         << " described per second on one thread\n";
    for (const std::string& line : report.unreadable)
        text << "unreadable: " << line << '\n';
    for (const CopiesRow& row : report.rows) {
        const auto within = [&](std::int64_t rank) {
            return std::count_if(
                row.ranks.begin(), row.ranks.end(), [=](auto r) { return r <= rank; });
        };
        text << row.query << " (" << row.profile << "): rank 1: " << within(1)
             << ", top 20: " << within(20) << " of " << row.ranks.size() << ", "
             << row.median_query_ms << " ms a query\n";
        for (std::size_t i = 0; i < row.ranks.size(); ++i) {
            if (row.ranks[i] > 1) {
                text << "  rank " << row.ranks[i] << ": " << report.targets[i] << '\n';
            }
        }
    }
    return std::move(text).str();
}

}  // namespace haarmony::eval
