#include "ingest/film_rows.h"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "ingest/describe.h"
#include "ingest/media_fragment.h"

namespace haarmony::ingest {
namespace {

std::string hash_of(const std::string& content) {
    return content_hash(
        {reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
}

schema::FileStamp stamp_of_row(const schema::FileStamp& film, std::string_view uri) {
    schema::FileStamp stamp = film;
    stamp.content_hash = key_frame_hash(film.content_hash, uri);
    return stamp;
}

// What came of reading a film, taken to its rows as they are now.
class FilmWriter {
  public:
    FilmWriter(Catalogue& catalogue, const std::string& uri, bool restore)
        : catalogue_(catalogue), uri_(uri), restore_(restore) {}

    Result<void> look_up() {
        Result<std::optional<schema::KnownFile>> own = catalogue_.known_file(uri_);
        if (!own) return own.error();
        own_ = *std::move(own);
        return catalogue_.for_each_file(
            key_frame_prefix(uri_),
            [this](const schema::KnownFile& known, const std::string& uri) {
                rows_.push_back({known, uri});
            });
    }

    Result<void> operator()(const SameContent& same) {
        if (!has_content(same.stamp)) {
            // Written by another process, or gone, while the film was read.
            ++tally_.skipped;
            return {};
        }
        return touch_all(same.stamp);
    }

    Result<void> operator()(const DescribedFilm& film) {
        std::map<std::string_view, const schema::KnownFile*> known;
        for (const FilmRow& row : rows_) known.emplace(row.uri, &row.known);
        for (const schema::NewImage& image : film.frames) {
            const auto row = known.find(image.uri);
            Result<void> written =
                row == known.end() ? add(image) : renew(*row->second, image);
            if (!written) return written;
            if (row != known.end()) known.erase(row);
        }
        for (const auto& [uri, row] : known) {
            if (auto purged = catalogue_.purge(row->id); !purged) return purged;
            ++tally_.pruned;
        }
        if (tally_.added == 0 && tally_.updated == 0) ++tally_.skipped;
        if (!own_) return {};
        return catalogue_.purge(own_->id);
    }

    Result<void> operator()(const Undecodable& film) {
        if (has_content(film.stamp)) return touch_all(film.stamp);
        ++tally_.failed;
        if (rows_.empty()) return catalogue_.mark_failed(uri_, film.stamp, film.reason);
        for (const FilmRow& row : rows_) {
            auto marked = catalogue_.mark_failed(
                row.uri, stamp_of_row(film.stamp, row.uri), film.reason);
            if (!marked) return marked;
        }
        return {};
    }

    Result<void> operator()(const Unreadable& film) {
        ++tally_.failed;
        const bool keeps_rows =
            std::any_of(rows_.begin(), rows_.end(), [](const auto& row) {
                return row.known.state != schema::ImageState::kFailed;
            });
        if (keeps_rows) return {};
        return catalogue_.mark_failed(uri_, film.stamp, film.reason);
    }

    // Never the reading of a film.
    Result<void> operator()(const Described&) { return {}; }

    [[nodiscard]] const Tally& tally() const { return tally_; }

  private:
    [[nodiscard]] bool has_content(const schema::FileStamp& film) const {
        return !rows_.empty() && !film.content_hash.empty() &&
               std::all_of(rows_.begin(), rows_.end(), [&](const FilmRow& row) {
                   return is_final(row.known, restore_) &&
                          row.known.stamp.content_hash ==
                              key_frame_hash(film.content_hash, row.uri);
               });
    }
    Result<void> touch_all(const schema::FileStamp& film) {
        for (const FilmRow& row : rows_) {
            auto touched = catalogue_.touch(row.known.id, stamp_of_row(film, row.uri));
            if (!touched) return touched;
        }
        ++tally_.skipped;
        return {};
    }
    Result<void> add(const schema::NewImage& image) {
        ++tally_.added;
        return catalogue_.add(image);
    }
    Result<void> renew(const schema::KnownFile& known, const schema::NewImage& image) {
        if (is_final(known, restore_) &&
            known.stamp.content_hash == image.stamp.content_hash) {
            return catalogue_.touch(known.id, image.stamp);
        }
        ++tally_.updated;
        return catalogue_.update(known.id, image);
    }

    Catalogue& catalogue_;
    const std::string& uri_;
    const bool restore_;
    std::optional<schema::KnownFile> own_;
    std::vector<FilmRow> rows_;
    Tally tally_{.seen = 1};
};

}  // namespace

std::string key_frame_hash(const std::string& film_hash, std::string_view uri) {
    return hash_of(film_hash + std::string(uri.substr(without_fragment(uri).size())));
}

Need film_need(const std::optional<schema::KnownFile>& own,
               const std::vector<FilmRow>& rows,
               const FileLook& look,
               bool restore) {
    if (rows.empty()) return first_need(own, look, restore);
    if (own) return Need::kDecode;
    Need need = Need::kNothing;
    for (const FilmRow& row : rows)
        need = std::max(need, first_need(row.known, look, restore));
    return need;
}

Result<Tally> write_film(Catalogue& catalogue,
                         const std::string& uri,
                         const Reading& reading,
                         bool restore) {
    FilmWriter writer(catalogue, uri, restore);
    Result<void> done = writer.look_up();
    if (done) done = std::visit(writer, reading);
    if (!done) return done.error();
    return writer.tally();
}

Result<void> drop_key_frames(Catalogue& catalogue, const std::string& uri) {
    std::vector<ImageId> rows;
    Result<void> done = catalogue.for_each_file(
        key_frame_prefix(uri), [&](const schema::KnownFile& known, const std::string&) {
            rows.push_back(known.id);
        });
    for (std::size_t i = 0; i < rows.size() && done; ++i) done = catalogue.purge(rows[i]);
    return done;
}

}  // namespace haarmony::ingest
