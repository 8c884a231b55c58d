#include "schema/curve_store.h"

#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// The curve of that name gives way to the new row, whose number is the new revision.
constexpr std::string_view kPut =
    "INSERT OR REPLACE INTO curves (kind, name, closed, dimension, numbers, updated_at)"
    " VALUES (?1, ?2, ?3, ?4, ?5, strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))";

constexpr std::string_view kColumns =
    "SELECT name, closed, dimension, numbers, updated_at, revision FROM curves";

constexpr std::size_t kBytes = sizeof(double);

std::string_view word_of(CurveKind kind) {
    return kind == CurveKind::kCharacter ? "character" : "stroke";
}

std::string quoted(CurveKind kind, std::string_view name) {
    return std::string(word_of(kind)) + " \"" + std::string(name) + '"';
}

Error no_such_curve(CurveKind kind, std::string_view name) {
    return Error{ErrorCode::kNotFound, "no " + quoted(kind, name), "name"};
}

std::vector<std::uint8_t> bytes_of(std::span<const double> numbers) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(numbers.size() * kBytes);
    for (const double number : numbers) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        for (std::size_t i = 0; i < kBytes; ++i)
            bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
    return bytes;
}

std::vector<double> numbers_of(std::span<const std::uint8_t> bytes) {
    std::vector<double> numbers;
    numbers.reserve(bytes.size() / kBytes);
    for (std::size_t at = 0; at + kBytes <= bytes.size(); at += kBytes) {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < kBytes; ++i)
            bits |= std::uint64_t{bytes[at + i]} << (8 * i);
        numbers.push_back(std::bit_cast<double>(bits));
    }
    return numbers;
}

// The table's constraints hold for every row that SQLite wrote; a file may have been through
// other hands.
Result<void> check_rows(const std::string& curve,
                        std::int64_t dimension,
                        std::int64_t bytes) {
    constexpr auto kNumber = static_cast<std::int64_t>(kBytes);
    if (dimension >= 1 && dimension <= 8 && bytes > 0 &&
        bytes % (kNumber * dimension) == 0)
        return {};
    return Error{ErrorCode::kIo,
                 curve + " has " + std::to_string(bytes) +
                     " bytes, which are no points of " + std::to_string(dimension) +
                     " numbers"};
}

Result<StoredCurve> curve_of(CurveKind kind, const Statement& row) {
    StoredCurve curve;
    curve.name = row.text(0);
    curve.closed = row.integer(1) != 0;
    const std::int64_t dimension = row.integer(2);
    const std::span<const std::uint8_t> bytes = row.bytes(3);
    const Result<void> whole = check_rows(
        quoted(kind, curve.name), dimension, static_cast<std::int64_t>(bytes.size()));
    if (!whole) return whole.error();
    curve.dimension = static_cast<int>(dimension);
    curve.numbers = numbers_of(bytes);
    curve.updated_at = row.text(4);
    curve.revision = row.integer(5);
    return curve;
}

Result<ListedCurve> listed_curve_of(CurveKind kind, const Statement& row) {
    ListedCurve curve;
    curve.name = row.text(0);
    curve.closed = row.integer(1) != 0;
    const std::int64_t dimension = row.integer(2);
    const std::int64_t bytes = row.integer(3);
    const Result<void> whole = check_rows(quoted(kind, curve.name), dimension, bytes);
    if (!whole) return whole.error();
    curve.dimension = static_cast<int>(dimension);
    curve.count = bytes / (static_cast<std::int64_t>(kBytes) * dimension);
    curve.updated_at = row.text(4);
    return curve;
}

Error cannot_list(CurveKind kind, Error error) {
    return while_doing("cannot list the " + std::string(word_of(kind)) + "s",
                       std::move(error));
}

}  // namespace

Result<void> CurveStore::put(CurveKind kind, const StoredCurve& curve) {
    const auto failed = [&](Error error) {
        return while_doing("cannot store " + quoted(kind, curve.name), std::move(error));
    };
    const std::vector<std::uint8_t> bytes = bytes_of(curve.numbers);  // outlives the loan
    auto statement = cache_.borrow(kPut);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    (*statement)->bind(2, curve.name);
    (*statement)->bind(3, std::int64_t{curve.closed});
    (*statement)->bind(4, std::int64_t{curve.dimension});
    (*statement)->bind(5, bytes);
    if (Result<void> stored = (*statement)->run(); !stored)
        return failed(std::move(stored).error());
    return {};
}

Result<StoredCurve> CurveStore::get(CurveKind kind, std::string_view name) {
    static const std::string sql =
        std::string(kColumns) + " WHERE kind = ?1 AND name = ?2";
    const auto failed = [&](Error error) {
        return while_doing("cannot read " + quoted(kind, name), std::move(error));
    };
    auto statement = cache_.borrow(sql);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    (*statement)->bind(2, name);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    if (!*row) return no_such_curve(kind, name);
    return curve_of(kind, **statement);
}

Result<std::vector<StoredCurve>> CurveStore::list(CurveKind kind) {
    static const std::string sql =
        std::string(kColumns) + " WHERE kind = ?1 ORDER BY name";
    auto statement = cache_.borrow(sql);
    if (!statement) return cannot_list(kind, std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    std::vector<StoredCurve> curves;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return cannot_list(kind, row.error());
        if (!*row) return curves;
        Result<StoredCurve> curve = curve_of(kind, **statement);
        if (!curve) return cannot_list(kind, std::move(curve).error());
        curves.push_back(std::move(curve).value());
    }
}

Result<std::vector<ListedCurve>> CurveStore::page(CurveKind kind,
                                                  std::string_view after,
                                                  int limit) {
    auto statement = cache_.borrow(
        "SELECT name, closed, dimension, length(numbers), updated_at FROM curves"
        " WHERE kind = ?1 AND name > ?2 ORDER BY name LIMIT ?3");
    if (!statement) return cannot_list(kind, std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    (*statement)->bind(2, after);
    (*statement)->bind(3, std::int64_t{limit});
    std::vector<ListedCurve> curves;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return cannot_list(kind, row.error());
        if (!*row) return curves;
        Result<ListedCurve> curve = listed_curve_of(kind, **statement);
        if (!curve) return cannot_list(kind, std::move(curve).error());
        curves.push_back(std::move(curve).value());
    }
}

Result<void> CurveStore::remove(CurveKind kind, std::string_view name) {
    const auto failed = [&](Error error) {
        return while_doing("cannot remove " + quoted(kind, name), std::move(error));
    };
    auto statement = cache_.borrow(
        "DELETE FROM curves WHERE kind = ?1 AND name = ?2 RETURNING revision");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    (*statement)->bind(2, name);
    const auto removed = (*statement)->run_returning();
    if (!removed) return failed(removed.error());
    if (!removed->has_value()) return no_such_curve(kind, name);
    return {};
}

Result<CurvesVersion> CurveStore::version(CurveKind kind) {
    const auto failed = [&](Error error) {
        return while_doing("cannot count the " + std::string(word_of(kind)) + "s",
                           std::move(error));
    };
    auto statement = cache_.borrow(
        "SELECT coalesce(max(revision), 0), count(*) FROM curves WHERE kind = ?1");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, word_of(kind));
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return CurvesVersion{(*statement)->integer(0), (*statement)->integer(1)};
}

}  // namespace haarmony::schema
