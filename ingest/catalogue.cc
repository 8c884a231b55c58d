#include "ingest/catalogue.h"

#include <utility>

#include "ingest/media_fragment.h"
#include "ingest/stored_profile.h"

namespace haarmony::ingest {

using schema::Database;

Result<std::unique_ptr<StoredCatalogue>> StoredCatalogue::open(const std::string& path) {
    Result<Database> writer = Database::open(path, Database::Mode::kReadWriteCreate);
    if (!writer) return std::move(writer).error();
    Result<Database> reader = Database::open(path, Database::Mode::kReadOnly);
    if (!reader) return std::move(reader).error();
    return std::unique_ptr<StoredCatalogue>(
        new StoredCatalogue(std::move(*writer), std::move(*reader)));
}

StoredCatalogue::StoredCatalogue(Database writer, Database reader)
    : writer_database_(std::move(writer)), reader_database_(std::move(reader)) {}

Result<std::vector<image::SignatureKind>> StoredCatalogue::kinds_in_use() {
    schema::ProfileStore profiles(reader_database_);
    return ingest::kinds_in_use(profiles);
}

Result<std::optional<schema::KnownFile>> StoredCatalogue::look_up(
    const std::string& uri) {
    return reader_.known_file(uri);
}

Result<std::vector<FilmRow>> StoredCatalogue::look_up_key_frames(const std::string& uri) {
    std::vector<FilmRow> rows;
    const Result<void> read = reader_.for_each_file(
        key_frame_prefix(uri),
        [&](const schema::KnownFile& known, const std::string& row_uri) {
            rows.push_back({known, row_uri});
        });
    if (!read) return read.error();
    return rows;
}

Result<void> StoredCatalogue::transaction(const std::function<Result<void>()>& work) {
    return writer_.transaction(work);
}

Result<std::optional<schema::KnownFile>> StoredCatalogue::known_file(
    const std::string& uri) {
    return writer_.known_file(uri);
}

Result<void> StoredCatalogue::add(const schema::NewImage& image) {
    const Result<ImageId> id = writer_.add(image);
    if (!id) return id.error();
    return {};
}

Result<void> StoredCatalogue::update(ImageId id, const schema::NewImage& image) {
    return writer_.update(id, image);
}

Result<void> StoredCatalogue::touch(ImageId id, const schema::FileStamp& stamp) {
    return writer_.touch(id, stamp);
}

Result<void> StoredCatalogue::mark_failed(const std::string& uri,
                                          const schema::FileStamp& stamp,
                                          const std::string& reason) {
    const Result<ImageId> id = writer_.mark_failed(uri, stamp, reason);
    if (!id) return id.error();
    return {};
}

Result<void> StoredCatalogue::purge(ImageId id) { return writer_.purge(id); }

Result<void> StoredCatalogue::for_each_file(
    const std::string& uri_prefix,
    const std::function<void(const schema::KnownFile&, const std::string& uri)>& visit) {
    return writer_.for_each_file(uri_prefix, visit);
}

}  // namespace haarmony::ingest
