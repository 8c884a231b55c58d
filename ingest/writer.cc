#include "ingest/writer.h"

#include <utility>
#include <variant>
#include <vector>

#include "ingest/film_rows.h"

namespace haarmony::ingest {
namespace {

const schema::FileStamp& stamp_in(const Reading& reading) {
    struct Stamp {
        const schema::FileStamp& operator()(const SameContent& same) const {
            return same.stamp;
        }
        const schema::FileStamp& operator()(const Described& described) const {
            return described.image.stamp;
        }
        const schema::FileStamp& operator()(const DescribedFilm& film) const {
            return film.stamp;
        }
        const schema::FileStamp& operator()(const Undecodable& undecodable) const {
            return undecodable.stamp;
        }
        const schema::FileStamp& operator()(const Unreadable& unreadable) const {
            return unreadable.stamp;
        }
    };
    return std::visit(Stamp{}, reading);
}

const std::string& reason_in(const Reading& reading) {
    if (const auto* unreadable = std::get_if<Unreadable>(&reading))
        return unreadable->reason;
    return std::get<Undecodable>(reading).reason;
}

Tally tally_of(CountedAs counted_as) {
    Tally tally{.seen = 1};
    switch (counted_as) {
        case CountedAs::kAdded:
            ++tally.added;
            break;
        case CountedAs::kUpdated:
            ++tally.updated;
            break;
        case CountedAs::kSkipped:
            ++tally.skipped;
            break;
        case CountedAs::kFailed:
            ++tally.failed;
            break;
    }
    return tally;
}

}  // namespace

Result<void> Writer::take(FileReading reading, Batch::TimePoint now) {
    batch_.add(std::move(reading), now);
    return write_if_due(now);
}

Result<void> Writer::write_if_due(Batch::TimePoint now) {
    return batch_.due(now) ? write() : Result<void>{};
}

Result<void> Writer::write() {
    if (batch_.empty()) return {};
    std::vector<Tally> counts;
    Result<void> written = catalogue_.transaction([&]() -> Result<void> {
        counts.clear();
        for (const FileReading& reading : batch_.readings()) {
            const Result<Tally> one = write_one(reading);
            if (!one) return one.error();
            counts.push_back(*one);
        }
        return {};
    });
    if (!written) return written;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        tally_ += counts[i];
        const FileReading& reading = batch_.readings()[i];
        if (counts[i].failed > 0)
            observer_.failed(reading.path, reason_in(reading.reading));
    }
    batch_.clear();
    return {};
}

Result<Tally> Writer::write_one(const FileReading& reading) {
    if (reading.is_film)
        return write_film(catalogue_, reading.uri, reading.reading, restore_);
    if (reading.has_key_frames) {
        const Result<void> dropped = drop_key_frames(catalogue_, reading.uri);
        if (!dropped) return dropped.error();
    }
    return write_picture(reading);
}

Result<Tally> Writer::write_picture(const FileReading& reading) {
    const Result<std::optional<schema::KnownFile>> known =
        catalogue_.known_file(reading.uri);
    if (!known) return known.error();
    const Settlement settlement = settle(*known, reading.reading, restore_);
    Result<void> written;
    switch (settlement.operation) {
        case RowOperation::kNone:
            break;
        case RowOperation::kTouch:
            written = catalogue_.touch((*known)->id, stamp_in(reading.reading));
            break;
        case RowOperation::kAdd:
            written = catalogue_.add(std::get<Described>(reading.reading).image);
            break;
        case RowOperation::kUpdate:
            written = catalogue_.update((*known)->id,
                                        std::get<Described>(reading.reading).image);
            break;
        case RowOperation::kMarkFailed:
            written = catalogue_.mark_failed(
                reading.uri, stamp_in(reading.reading), reason_in(reading.reading));
            break;
    }
    if (!written) return written.error();
    return tally_of(settlement.counted_as);
}

void Writer::count_unchanged() {
    ++tally_.seen;
    ++tally_.skipped;
}

void Writer::report_failure(const std::string& path, const std::string& reason) {
    ++tally_.failed;
    observer_.failed(path, reason);
}

}  // namespace haarmony::ingest
