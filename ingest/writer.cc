#include "ingest/writer.h"

#include <utility>
#include <variant>
#include <vector>

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
    std::vector<Settlement> settlements;
    Result<void> written = catalogue_.transaction([&]() -> Result<void> {
        settlements.assign(batch_.readings().size(), {});
        for (std::size_t i = 0; i < settlements.size(); ++i) {
            Result<void> one = write_one(batch_.readings()[i], settlements[i]);
            if (!one) return one;
        }
        return {};
    });
    if (!written) return written;
    for (std::size_t i = 0; i < settlements.size(); ++i) {
        const FileReading& reading = batch_.readings()[i];
        ++tally_.seen;
        switch (settlements[i].counted_as) {
            case CountedAs::kAdded:
                ++tally_.added;
                break;
            case CountedAs::kUpdated:
                ++tally_.updated;
                break;
            case CountedAs::kSkipped:
                ++tally_.skipped;
                break;
            case CountedAs::kFailed:
                report_failure(reading.path, reason_in(reading.reading));
                break;
        }
    }
    batch_.clear();
    return {};
}

Result<void> Writer::write_one(const FileReading& reading, Settlement& settlement) {
    const Result<std::optional<schema::KnownFile>> known =
        catalogue_.known_file(reading.uri);
    if (!known) return known.error();
    settlement = settle(*known, reading.reading, restore_);
    switch (settlement.operation) {
        case RowOperation::kNone:
            return {};
        case RowOperation::kTouch:
            return catalogue_.touch((*known)->id, stamp_in(reading.reading));
        case RowOperation::kAdd:
            return catalogue_.add(std::get<Described>(reading.reading).image);
        case RowOperation::kUpdate:
            return catalogue_.update((*known)->id,
                                     std::get<Described>(reading.reading).image);
        case RowOperation::kMarkFailed:
            return catalogue_.mark_failed(
                reading.uri, stamp_in(reading.reading), reason_in(reading.reading));
    }
    return {};
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
