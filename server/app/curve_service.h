// The curves that have names: a library of characters, some of them built in, and strokes.
//
//   server/api -> [curve_service] -> schema/curve_store.h, engine/curve
//
// A write is visible to the next read when it returns.
//
// Errors   the store's; kConflict for a change to a built-in character.
// Threads  every member from any thread. Reads borrow a connection each, writes follow one
//          another on one.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"
#include "engine/curve/stroke_index.h"
#include "server/app/connection.h"

namespace haarmony::server {

struct NamedCurve {
    std::string name;
    bool built_in = false;
    curve::Ends ends = curve::Ends::kOpen;
    curve::Points points;    // control points of a character, samples of a stroke
    std::string updated_at;  // empty: built in
    std::int64_t revision = 0;
};

// What a list shows of one.
struct ListedCurve {
    std::string name;
    bool built_in = false;
    curve::Ends ends = curve::Ends::kOpen;
    int dimension = 0;
    std::size_t count = 0;  // of points
    std::string updated_at;
};

struct CurvePage {
    std::vector<ListedCurve> items;
    bool more = false;  // behind the last one
};

struct PutCurve {
    NamedCurve curve;
    bool created = false;  // nothing had that name
};

struct StrokeMatches {
    std::vector<curve::StrokeMatch> best;
    std::size_t strokes = 0;  // that were compared
};

class CurveService {
  public:
    // The database must exist.
    [[nodiscard]] static Result<std::unique_ptr<CurveService>> open(
        const std::string& database_path);

    // Those behind the name `after`, "" for the first ones: the built-in ones first, then in
    // the order of names. Requires: 1 <= limit.
    [[nodiscard]] Result<CurvePage> characters(std::string_view after, int limit);
    [[nodiscard]] Result<NamedCurve> character(std::string_view name);
    // Inserts or replaces. Requires: control points of a level.
    [[nodiscard]] Result<PutCurve> put_character(const NamedCurve& character);
    [[nodiscard]] Result<void> remove_character(std::string_view name);

    [[nodiscard]] Result<CurvePage> strokes(std::string_view after, int limit);
    [[nodiscard]] Result<NamedCurve> stroke(std::string_view name);
    [[nodiscard]] Result<PutCurve> put_stroke(const NamedCurve& stroke);
    [[nodiscard]] Result<void> remove_stroke(std::string_view name);
    // The strokes most alike in handwriting, best first. Requires: at least 2 samples.
    [[nodiscard]] Result<StrokeMatches> match(const curve::Points& samples,
                                              std::size_t limit);

  private:
    CurveService(const std::string& database_path, std::unique_ptr<Connection> writer);

    [[nodiscard]] Result<NamedCurve> get(schema::CurveKind kind, std::string_view name);
    [[nodiscard]] Result<CurvePage> stored_page(schema::CurveKind kind,
                                                std::string_view after,
                                                int limit);
    [[nodiscard]] Result<PutCurve> put(schema::CurveKind kind, const NamedCurve& curve);
    [[nodiscard]] Result<void> remove(schema::CurveKind kind, std::string_view name);

    // The signatures of all strokes as they are now; made anew where any has changed.
    [[nodiscard]] Result<std::shared_ptr<const curve::StrokeIndex>> stroke_index();

    std::mutex writer_mutex_;  // guards writer_
    std::unique_ptr<Connection> writer_;
    ReadConnections readers_;
    std::mutex strokes_mutex_;  // guards the next two; held while an index is made
    std::shared_ptr<const curve::StrokeIndex> strokes_;
    schema::CurvesVersion strokes_version_;
};

}  // namespace haarmony::server
