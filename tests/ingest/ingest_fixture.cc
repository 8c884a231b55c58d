#include "tests/ingest/ingest_fixture.h"

#include <filesystem>
#include <regex>
#include <sstream>

#include "ingest/file_uri.h"
#include "ingest/thumbnail.h"
#include "schema/database.h"

namespace haarmony::ingest {

using schema::Database;
using schema::ImageStore;
using schema::KnownFile;

std::string jpeg_of(int number, int width, int height) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(static_cast<std::size_t>(width) * height * 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            pixels.push_back(static_cast<std::uint8_t>(x * 255 / width));
            pixels.push_back(
                static_cast<std::uint8_t>((y * 255 / height) ^ (number & 255)));
            pixels.push_back(static_cast<std::uint8_t>((number >> 8) * 16 + x / 8 % 16));
        }
    }
    const auto jpeg = encode_jpeg({pixels.data(), width, height, 3, width * 3}, 90);
    if (!jpeg) std::abort();
    return {jpeg->begin(), jpeg->end()};
}

std::vector<std::string> IngestFixture::command(
    const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{HAARMONY_INGEST, "--db", database_};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
}

Finished IngestFixture::ingest(const std::vector<std::string>& arguments,
                               const ChildOptions& options) const {
    return run_to_end(command(arguments), options);
}

void IngestFixture::expect_ingested(const std::string& counts, int status) const {
    const Finished finished = ingest({"--progress", "none", pictures_});
    EXPECT_EQ(finished.status, status) << finished.err;
    EXPECT_EQ(counts_of(finished.out), counts) << finished.out << finished.err;
}

std::map<std::string, StoredRow> IngestFixture::rows(const std::string& path) const {
    std::map<std::string, StoredRow> rows;
    if (!std::filesystem::exists(path)) return rows;
    Result<Database> database = Database::open(path, Database::Mode::kReadOnly);
    if (!database) return rows;
    ImageStore store(*database);
    std::vector<std::pair<KnownFile, std::string>> known;
    EXPECT_TRUE(store.for_each_file("file://",
                                    [&](const KnownFile& file, const std::string& uri) {
                                        known.emplace_back(file, uri);
                                    }));
    for (const auto& [file, uri] : known) {
        StoredRow row;
        row.id = to_int(file.id);
        row.state = file.state;
        row.content_hash = file.stamp.content_hash;
        row.size = file.stamp.size;
        row.mtime_ns = file.stamp.mtime_ns;
        if (file.state == schema::ImageState::kIndexed) {
            const auto image = store.get(file.id);
            const auto signature = store.signature(file.id);
            const auto thumbnail = store.thumbnail(file.id);
            EXPECT_TRUE(image && signature && thumbnail) << uri;
            if (!image || !signature || !thumbnail) continue;
            row.width = image->width;
            row.height = image->height;
            row.media_type = image->media_type;
            row.signature = *signature;
            row.thumbnail = thumbnail->bytes;
        }
        rows[*path_from_file_uri(uri)] = row;
    }
    return rows;
}

void IngestFixture::remove_row(const std::string& path) const {
    Result<Database> database =
        Database::open(database_, Database::Mode::kReadWriteCreate);
    ASSERT_TRUE(database);
    ImageStore store(*database);
    ASSERT_TRUE(store.remove(ImageId{rows().at(path).id}));
}

std::string counts_of(const std::string& out) {
    static const std::regex kDone(
        "done: (seen=\\d+ added=\\d+ updated=\\d+ skipped=\\d+ failed=\\d+ pruned=\\d+) "
        "seconds=\\d+\\.\\d+");
    const std::vector<std::string> lines = lines_of(out);
    std::smatch match;
    if (lines.empty() || !std::regex_match(lines.back(), match, kDone))
        return "no done line";
    return match[1];
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace haarmony::ingest
