#include "tests/bench/start/parts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>

#include "server/app/lending_pool.h"
#include "server/app/mapped_file.h"
#include "server/app/rebuild.h"
#include "server/app/snapshot_reader.h"
#include "server/app/snapshot_writer.h"
#include "server/app/thread_executor.h"

namespace haarmony::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Of all threads of the process.
double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

template <typename T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(result).value();
}

server::ReadConnections connections_to(const std::string& database) {
    return server::ReadConnections([database] {
        return server::Connection::open(database, schema::Database::Mode::kReadOnly);
    });
}

bool always() { return true; }

}  // namespace

ReadTime read_signatures(const PartsOptions& options) {
    server::ReadConnections connections = connections_to(options.database);
    server::ThreadExecutor executor(options.threads - 1);
    ReadTime time;
    const auto started = Clock::now();
    const double before = processor_seconds();
    auto connection = must(connections.lend());
    const schema::Counts counts = must(connection->images().counts());
    const int size = server::pictures_per_segment(counts.indexed, options.threads);
    const auto ranges = must(connection->images().searchable_ranges(size));
    server::LendingPool<server::StoredPictures> pool(
        [&]() -> Result<std::unique_ptr<server::StoredPictures>> {
            return std::make_unique<server::StoredPictures>(
                options.index_m, std::size_t{image::kMaxSegmentSlots});
        });
    std::atomic<std::int64_t> images{0};
    executor.parallel_for(ranges.size(), [&](std::size_t i) {
        const auto own = must(connections.lend());
        const auto pictures = must(pool.lend());
        const auto read =
            pictures->read(own->images(), ranges[i], std::size_t(size), always);
        if (!read) throw std::runtime_error(read.error().message);
        images += pictures->images();
    });
    time.seconds = seconds_since(started);
    time.processor_seconds = processor_seconds() - before;
    time.images = images;
    return time;
}

RebuildTime rebuild_and_write(const PartsOptions& options, const std::string& snapshot) {
    server::ReadConnections connections = connections_to(options.database);
    server::ThreadExecutor executor(options.threads - 1);
    server::RebuildOptions rebuilding;
    rebuilding.index_m = options.index_m;
    rebuilding.threads = options.threads;
    rebuilding.go_on = always;
    RebuildTime time;
    auto started = Clock::now();
    const double before = processor_seconds();
    server::Rebuilt rebuilt = must(server::rebuild(connections, rebuilding, executor));
    time.seconds = seconds_since(started);
    time.processor_seconds = processor_seconds() - before;
    time.images = rebuilt.images;

    server::SnapshotContents contents;
    contents.index_m = options.index_m;
    contents.segments = std::move(rebuilt.segments);
    server::SnapshotWriting writing;
    writing.path = snapshot;
    // Nobody asks whose file it is.
    writing.token = [] { return Result<schema::SnapshotToken>(schema::SnapshotToken{}); };
    writing.go_on = [](std::uint64_t, std::uint64_t) { return true; };
    started = Clock::now();
    time.snapshot_bytes = must(server::write_snapshot(contents, writing, executor));
    time.snapshot_seconds = seconds_since(started);
    return time;
}

MapTime map_snapshot(const PartsOptions& options, const std::string& snapshot) {
    MapTime time;
    {
        const auto started = Clock::now();
        const double before = processor_seconds();
        server::ThreadExecutor executor(options.threads - 1);
        const auto contents = must(server::read_snapshot(
            snapshot,
            options.index_m,
            [](const server::SnapshotTable&) { return Result<void>(); },
            executor));
        time.seconds = seconds_since(started);
        time.processor_seconds = processor_seconds() - before;
    }
    const auto started = Clock::now();
    server::ThreadExecutor executor(options.threads - 1);
    const auto file = must(server::MappedFile::open(snapshot));
    const auto table = must(server::decode_table(file->bytes()));
    std::vector<std::span<const std::byte>> extents;
    auto rest = file->bytes().subspan(table.parts_begin());
    for (const server::SnapshotPart& part : table.parts) {
        extents.push_back(rest.first(part.extent()));
        rest = rest.subspan(part.extent());
    }
    std::atomic<std::uint64_t> sums{0};
    executor.parallel_for(extents.size(), [&](std::size_t i) {
        server::MappedFile::expect(extents[i]);
        sums += server::snapshot_checksum(extents[i]);
    });
    time.checksum_seconds = seconds_since(started);
    return time;
}

}  // namespace haarmony::bench
