// What ingest needs of the database, so that tests can stand in for it and fail at will.
//
// Errors  as ImageStore.
// Threads look_up() and look_up_key_frames() are called on the walker's thread; everything else on the thread that
//         called run(), and all that writes inside transaction().
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/signature_kind.h"
#include "schema/database.h"
#include "schema/image_store.h"

namespace haarmony::ingest {

// One of the rows of a film (film_rows.h).
struct FilmRow {
    schema::KnownFile known;
    std::string uri;
};

class Catalogue {
  public:
    virtual ~Catalogue() = default;

    [[nodiscard]] virtual Result<std::optional<schema::KnownFile>> look_up(
        const std::string& uri) = 0;
    // The rows of a film's key frames.
    [[nodiscard]] virtual Result<std::vector<FilmRow>> look_up_key_frames(
        const std::string& uri) = 0;

    [[nodiscard]] virtual Result<void> transaction(
        const std::function<Result<void>()>& work) = 0;
    [[nodiscard]] virtual Result<std::optional<schema::KnownFile>> known_file(
        const std::string& uri) = 0;
    [[nodiscard]] virtual Result<void> add(const schema::NewImage& image) = 0;
    [[nodiscard]] virtual Result<void> update(ImageId id,
                                              const schema::NewImage& image) = 0;
    [[nodiscard]] virtual Result<void> touch(ImageId id,
                                             const schema::FileStamp& stamp) = 0;
    [[nodiscard]] virtual Result<void> mark_failed(const std::string& uri,
                                                   const schema::FileStamp& stamp,
                                                   const std::string& reason) = 0;
    [[nodiscard]] virtual Result<void> purge(ImageId id) = 0;
    [[nodiscard]] virtual Result<void> for_each_file(
        const std::string& uri_prefix,
        const std::function<void(const schema::KnownFile&, const std::string& uri)>&
            visit) = 0;
};

// The database file, through two connections: one that reads and one that writes.
class StoredCatalogue final : public Catalogue {
  public:
    // Errors: as Database::open.
    [[nodiscard]] static Result<std::unique_ptr<StoredCatalogue>> open(
        const std::string& path);

    // What the profiles of this database compare: see stored_profile.h.
    [[nodiscard]] Result<std::vector<image::SignatureKind>> kinds_in_use();

    Result<std::optional<schema::KnownFile>> look_up(const std::string& uri) override;
    Result<std::vector<FilmRow>> look_up_key_frames(const std::string& uri) override;
    Result<void> transaction(const std::function<Result<void>()>& work) override;
    Result<std::optional<schema::KnownFile>> known_file(const std::string& uri) override;
    Result<void> add(const schema::NewImage& image) override;
    Result<void> update(ImageId id, const schema::NewImage& image) override;
    Result<void> touch(ImageId id, const schema::FileStamp& stamp) override;
    Result<void> mark_failed(const std::string& uri,
                             const schema::FileStamp& stamp,
                             const std::string& reason) override;
    Result<void> purge(ImageId id) override;
    Result<void> for_each_file(
        const std::string& uri_prefix,
        const std::function<void(const schema::KnownFile&, const std::string& uri)>&
            visit) override;

  private:
    StoredCatalogue(schema::Database writer, schema::Database reader);

    schema::Database writer_database_;
    schema::Database reader_database_;
    schema::ImageStore writer_{writer_database_};
    schema::ImageStore reader_{reader_database_};
};

}  // namespace haarmony::ingest
