#include "server/app/curve_service.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "engine/curve/built_in_character.h"
#include "server/app/logged.h"

namespace haarmony::server {
namespace {

using schema::CurveKind;

// Details that turn with the stroke: a word written aslant is the same word.
constexpr curve::Frame kStrokeFrame = curve::Frame::kNormalized;

Error built_in_error(std::string_view name) {
    return {ErrorCode::kConflict,
            "the character '" + std::string(name) + "' is built in: it cannot be changed",
            "name"};
}

NamedCurve built_in(const curve::BuiltInCharacter& character) {
    NamedCurve named;
    named.name = character.name;
    named.built_in = true;
    named.points = character.stroke();
    return named;
}

ListedCurve listed(const curve::BuiltInCharacter& character) {
    const curve::Points points = character.stroke();
    return {std::string(character.name),
            true,
            curve::Ends::kOpen,
            points.dimension(),
            points.size(),
            {}};
}

// A row that was written by other hands than put()'s.
Result<void> check_count(CurveKind kind,
                         const std::string& name,
                         std::size_t count,
                         curve::Ends ends) {
    if (kind == CurveKind::kStroke && count < 2)
        return Error{ErrorCode::kIo, "stroke \"" + name + "\" has one sample"};
    if (kind == CurveKind::kCharacter && !curve::level_of(count, ends))
        return Error{ErrorCode::kIo,
                     "character \"" + name + "\" has " + std::to_string(count) +
                         " control points, as no level has"};
    return {};
}

Result<NamedCurve> named(CurveKind kind, const schema::StoredCurve& stored) {
    NamedCurve curve;
    curve.name = stored.name;
    curve.ends = stored.closed ? curve::Ends::kClosed : curve::Ends::kOpen;
    const auto dimension = static_cast<std::size_t>(stored.dimension);
    curve.points = curve::Points(stored.numbers.size() / dimension, stored.dimension);
    std::ranges::copy(stored.numbers, curve.points.numbers().begin());
    curve.updated_at = stored.updated_at;
    curve.revision = stored.revision;
    const Result<void> possible =
        check_count(kind, curve.name, curve.points.size(), curve.ends);
    if (!possible) return possible.error();
    return curve;
}

schema::StoredCurve to_stored(const NamedCurve& curve) {
    schema::StoredCurve stored;
    stored.name = curve.name;
    stored.closed = curve.ends == curve::Ends::kClosed;
    stored.dimension = curve.points.dimension();
    stored.numbers.assign(curve.points.numbers().begin(), curve.points.numbers().end());
    return stored;
}

}  // namespace

Result<std::unique_ptr<CurveService>> CurveService::open(
    const std::string& database_path) {
    auto writer =
        Connection::open(database_path, schema::Database::Mode::kReadWriteCreate);
    if (!writer) return std::move(writer).error();
    return std::unique_ptr<CurveService>(
        new CurveService(database_path, std::move(writer).value()));
}

CurveService::CurveService(const std::string& database_path,
                           std::unique_ptr<Connection> writer)
    : writer_(std::move(writer)), readers_([path = database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }) {}

Result<NamedCurve> CurveService::get(CurveKind kind, std::string_view name) {
    auto connection = readers_.lend();
    if (!connection) return logged(Result<NamedCurve>(connection.error()));
    const auto stored = (*connection)->curves().get(kind, name);
    if (!stored) return logged(Result<NamedCurve>(stored.error()));
    return logged(named(kind, stored.value()));
}

Result<PutCurve> CurveService::put(CurveKind kind, const NamedCurve& curve) {
    const auto work = [&]() -> Result<PutCurve> {
        const std::lock_guard lock(writer_mutex_);
        schema::CurveStore& curves = writer_->curves();
        const auto before = curves.get(kind, curve.name);
        if (!before && before.error().code != ErrorCode::kNotFound) return before.error();
        if (const auto stored = curves.put(kind, to_stored(curve)); !stored)
            return stored.error();
        const auto after = curves.get(kind, curve.name);
        if (!after) return after.error();
        auto put = named(kind, after.value());
        if (!put) return put.error();
        return PutCurve{std::move(put).value(), !before.has_value()};
    };
    return logged(work());
}

Result<void> CurveService::remove(CurveKind kind, std::string_view name) {
    const std::lock_guard lock(writer_mutex_);
    return logged(writer_->curves().remove(kind, name));
}

Result<CurvePage> CurveService::stored_page(CurveKind kind,
                                            std::string_view after,
                                            int limit) {
    auto connection = readers_.lend();
    if (!connection) return logged(Result<CurvePage>(connection.error()));
    // One more than asked for tells whether there is a next page.
    const auto stored = (*connection)->curves().page(kind, after, limit + 1);
    if (!stored) return logged(Result<CurvePage>(stored.error()));
    CurvePage page;
    for (const schema::ListedCurve& one : stored.value()) {
        page.more = page.items.size() == static_cast<std::size_t>(limit);
        if (page.more) break;
        ListedCurve& listed = page.items.emplace_back();
        listed.name = one.name;
        listed.ends = one.closed ? curve::Ends::kClosed : curve::Ends::kOpen;
        listed.dimension = one.dimension;
        listed.count = static_cast<std::size_t>(one.count);
        listed.updated_at = one.updated_at;
        const Result<void> possible =
            check_count(kind, listed.name, listed.count, listed.ends);
        if (!possible) return logged(Result<CurvePage>(possible.error()));
    }
    return page;
}

Result<CurvePage> CurveService::characters(std::string_view after, int limit) {
    const std::span<const curve::BuiltInCharacter> built_in =
        curve::built_in_characters();
    auto next = built_in.begin();
    std::string_view stored_after;
    if (!after.empty()) {
        next = std::ranges::find_if(
            built_in, [&](const auto& character) { return character.name == after; });
        if (next == built_in.end())
            stored_after = after;
        else
            ++next;
    }
    CurvePage page;
    for (; next != built_in.end() && std::ssize(page.items) < limit; ++next)
        page.items.push_back(listed(*next));
    auto stored = stored_page(
        CurveKind::kCharacter, stored_after, limit - static_cast<int>(page.items.size()));
    if (!stored) return stored;
    std::ranges::move(stored->items, std::back_inserter(page.items));
    page.more = next != built_in.end() || stored->more;
    return page;
}

Result<NamedCurve> CurveService::character(std::string_view name) {
    if (const auto* character = curve::built_in_character(name))
        return built_in(*character);
    return get(CurveKind::kCharacter, name);
}

Result<PutCurve> CurveService::put_character(const NamedCurve& character) {
    if (curve::built_in_character(character.name) != nullptr)
        return built_in_error(character.name);
    return put(CurveKind::kCharacter, character);
}

Result<void> CurveService::remove_character(std::string_view name) {
    if (curve::built_in_character(name) != nullptr) return built_in_error(name);
    return remove(CurveKind::kCharacter, name);
}

Result<CurvePage> CurveService::strokes(std::string_view after, int limit) {
    return stored_page(CurveKind::kStroke, after, limit);
}

Result<NamedCurve> CurveService::stroke(std::string_view name) {
    return get(CurveKind::kStroke, name);
}

Result<PutCurve> CurveService::put_stroke(const NamedCurve& stroke) {
    return put(CurveKind::kStroke, stroke);
}

Result<void> CurveService::remove_stroke(std::string_view name) {
    return remove(CurveKind::kStroke, name);
}

Result<std::shared_ptr<const curve::StrokeIndex>> CurveService::stroke_index() {
    using Answer = Result<std::shared_ptr<const curve::StrokeIndex>>;
    auto connection = readers_.lend();
    if (!connection) return logged(Answer(connection.error()));
    schema::CurveStore& curves = (*connection)->curves();
    const std::lock_guard lock(strokes_mutex_);
    // Asked before the strokes are read: what comes in between is read again next time.
    const auto version = curves.version(CurveKind::kStroke);
    if (!version) return logged(Answer(version.error()));
    if (strokes_ && version.value() == strokes_version_) return strokes_;
    const auto stored = curves.list(CurveKind::kStroke);
    if (!stored) return logged(Answer(stored.error()));
    auto index = std::make_shared<curve::StrokeIndex>();
    for (const schema::StoredCurve& one : stored.value()) {
        const auto stroke = named(CurveKind::kStroke, one);
        if (!stroke) return logged(Answer(stroke.error()));
        index->add(stroke->name, curve::stroke_signature(stroke->points, kStrokeFrame));
    }
    strokes_ = std::move(index);
    strokes_version_ = version.value();
    return strokes_;
}

Result<StrokeMatches> CurveService::match(const curve::Points& samples,
                                          std::size_t limit) {
    const auto index = stroke_index();
    if (!index) return index.error();
    return StrokeMatches{
        index.value()->query(curve::stroke_signature(samples, kStrokeFrame), limit),
        index.value()->size()};
}

}  // namespace haarmony::server
