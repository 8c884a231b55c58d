// Collections of random pictures as snapshot files hold them, and what a search of them finds.
#pragma once

#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/query.h"
#include "server/app/snapshot_writer.h"
#include "tests/engine/image/segment_bytes.h"

namespace haarmony::server {

inline constexpr int kSnapshotIndexM = 45;
inline constexpr schema::SnapshotToken kSomeToken{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

// An index of `count` pictures, some of them gone again, some in the tail.
inline std::unique_ptr<image::Index> some_index(unsigned seed, int count) {
    std::mt19937 random(seed);
    auto index = std::make_unique<image::Index>(image::IndexOptions{kSnapshotIndexM, 64});
    const std::vector<image::Record> records = image::make_records(random, count);
    for (std::span<const image::Record> rest = records; !rest.empty();) {
        const auto some = rest.first(std::min<std::size_t>(rest.size(), 50));
        index->apply(some, {});
        rest = rest.subspan(some.size());
    }
    std::vector<ImageId> gone;
    for (std::size_t i = 0; i < records.size(); i += 9) gone.push_back(records[i].id);
    index->apply({}, gone);
    return index;
}

inline SnapshotContents some_contents() {
    SnapshotContents contents;
    contents.sequence = 1234;
    contents.index_m = kSnapshotIndexM;
    contents.damaged = {ImageId{7}, ImageId{900}};
    contents.segments["yiq-standard"] = some_index(1, 180)->snapshot()->sealed();
    contents.segments["lab-standard"] = some_index(2, 60)->snapshot()->sealed();
    contents.segments["empty"];
    return contents;
}

// Every score of every variant, for several m.
using Answers = std::map<std::string, std::vector<std::pair<std::int64_t, image::Score>>>;
inline Answers answers_of(const SegmentsByVariant& segments) {
    Answers answers;
    std::mt19937 random(3);
    for (const auto& [variant, of_variant] : segments) {
        image::Index index({kSnapshotIndexM, 64});
        index.reset(of_variant, image::SegmentOrigin::kBuilt);
        auto& found = answers[variant];
        for (const int m : {20, 31, kSnapshotIndexM}) {
            const image::Query query =
                image::make_query(image::random_signature(random, {60, 120}),
                                  *image::built_in_profile("painted"),
                                  m);
            for (const image::Match& match :
                 index.snapshot()->search(query, {1000}).matches)
                found.emplace_back(to_int(match.id), match.score);
        }
    }
    return answers;
}

// Writes them as a file that knows kSomeToken.
inline Result<std::uint64_t> write_some(const SnapshotContents& contents,
                                        const std::string& path) {
    SnapshotWriting writing;
    writing.path = path;
    writing.token = [] { return Result<schema::SnapshotToken>(kSomeToken); };
    writing.go_on = [](std::uint64_t, std::uint64_t) { return true; };
    InlineExecutor executor;
    return write_snapshot(contents, writing, executor);
}

inline Result<SnapshotContents> read_some(const std::string& path,
                                          int index_m = kSnapshotIndexM) {
    InlineExecutor executor;
    return read_snapshot(
        path, index_m, [](const SnapshotTable&) { return Result<void>(); }, executor);
}

inline std::string bytes_in(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
inline void put_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace haarmony::server
