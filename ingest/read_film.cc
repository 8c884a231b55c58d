#include "ingest/read_film.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <span>
#include <system_error>
#include <utility>

#include "ingest/film_rows.h"
#include "ingest/media_fragment.h"
#include "ingest/sniff.h"
#include "ingest/video_format.h"

namespace haarmony::ingest {
namespace {

// An address has no character that a string of JSON would have to escape.
std::string metadata_of(const std::string& film, const KeyFrame& frame) {
    std::array<char, 32> seconds{};
    std::snprintf(
        seconds.data(), seconds.size(), "%.3f", static_cast<double>(frame.time_us) / 1e6);
    return R"({"video":")" + film + R"(","time":)" + seconds.data() + R"(,"frame":)" +
           std::to_string(frame.number) + '}';
}

bool have_content(const std::vector<FilmRow>& rows, const std::string& film_hash) {
    return !rows.empty() &&
           std::all_of(rows.begin(), rows.end(), [&](const FilmRow& row) {
               return row.known.stamp.content_hash == key_frame_hash(film_hash, row.uri);
           });
}

DescribedFilm rows_of(std::vector<KeyFrame> frames,
                      const std::string& uri,
                      const std::string& media_type,
                      const schema::FileStamp& stamp) {
    DescribedFilm film{stamp, {}};
    for (KeyFrame& frame : frames) {
        schema::NewImage image = std::move(frame.image);
        image.origin = schema::ImageOrigin::kFile;
        image.uri = key_frame_uri(uri, frame.time_us);
        image.stamp = stamp;
        image.stamp.content_hash = key_frame_hash(stamp.content_hash, image.uri);
        image.media_type = media_type;
        image.metadata = metadata_of(uri, frame);
        film.frames.push_back(std::move(image));
    }
    return film;
}

}  // namespace

std::optional<OpenFilm> open_film(const std::string& path) {
    // The file may have become a fifo: O_NONBLOCK keeps open() from waiting for a writer.
    FileDescriptor file = open_path(path, O_RDONLY | O_NONBLOCK | O_NOCTTY);
    struct stat status {};
    if (!file.valid() || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode))
        return std::nullopt;
    std::array<std::uint8_t, kSniffBytes> begin{};
    const ssize_t count = ::pread(file.get(), begin.data(), begin.size(), 0);
    if (count <= 0) return std::nullopt;
    const auto bytes = std::span(begin).first(static_cast<std::size_t>(count));
    if (const auto type = sniff(bytes); type && type->format) return std::nullopt;
    const auto format = sniff_video(bytes);
    if (!format || !is_film(*format)) return std::nullopt;
    return OpenFilm{
        std::move(file), look_of(status), std::string(media_type_of(*format))};
}

std::optional<Reading> read_film(const OpenFilm& film,
                                 const std::string& uri,
                                 const std::vector<FilmRow>& known,
                                 Need need,
                                 const FilmSteps& steps,
                                 const KeepGoing& keep_going) {
    // The clock is read first: a change during or after the reading is never older.
    const std::int64_t started_ns = now_ns();
    const auto unreadable = [&](const std::string& reason) {
        return Unreadable{stamp_of(film.look, started_ns, {}), reason};
    };
    const int file = film.file.get();
    const Result<std::string> hash = steps.content_hash(file, keep_going);
    if (!keep_going()) return std::nullopt;
    if (!hash) return unreadable(hash.error().message);
    const schema::FileStamp stamp = stamp_of(film.look, started_ns, *hash);
    if (need == Need::kCompare && have_content(known, *hash)) return SameContent{stamp};
    Result<std::vector<KeyFrame>> frames = steps.describe(file, keep_going);
    if (!keep_going()) return std::nullopt;
    struct stat after {};
    if (::fstat(file, &after) != 0)
        return unreadable(std::generic_category().message(errno));
    if (look_of(after) != film.look) return unreadable("changes while it is read");
    if (!frames) {
        // The decoder could not be started: no fault of the film's.
        if (frames.error().code == ErrorCode::kIo)
            return unreadable(frames.error().message);
        return Undecodable{stamp, frames.error().message};
    }
    return rows_of(*std::move(frames), uri, film.media_type, stamp);
}

}  // namespace haarmony::ingest
