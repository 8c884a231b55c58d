#include "tests/eval/replay.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <random>
#include <set>
#include <utility>

#include "engine/image/random_order.h"
#include "engine/image/signature_codec.h"
#include "ingest/stored_profile.h"
#include "ingest/variant.h"
#include "server/api/training_pair_json.h"
#include "server/app/connection.h"

namespace haarmony::eval {
namespace {

constexpr int kScreen = 20;  // pictures that a user sees at a time
constexpr int kBatch = 1000;

// With those that never found their target counted as the longest of all.
template <typename T>
std::optional<T> median(std::vector<std::optional<T>> values) {
    if (values.empty()) return {};
    std::ranges::sort(values, [](const std::optional<T>& a, const std::optional<T>& b) {
        return a && (!b || *a < *b);
    });
    return values[(values.size() - 1) / 2];
}

Result<std::vector<LoggedPainting>> read_paintings(server::Connection& connection) {
    std::vector<LoggedPainting> paintings;
    std::optional<std::int64_t> after;
    for (;;) {
        const auto logged = connection.feedback().list(std::nullopt, after, kBatch);
        if (!logged) return logged.error();
        for (const schema::Feedback& feedback : *logged) {
            after = feedback.id;
            std::optional<server::QueryPair> pair = server::stored_pair(feedback);
            if (!pair || !pair->strokes) continue;
            paintings.push_back(
                {*std::move(pair->strokes), feedback.target, feedback.seconds});
        }
        if (static_cast<int>(logged->size()) < kBatch) return paintings;
    }
}

// The signatures that a profile compares; pictures without one are left out.
Result<std::vector<image::Record>> read_pictures(server::Connection& connection,
                                                 const image::Profile& profile) {
    const std::string variant = ingest::variant_name(profile.kind, ingest::Look::kWhole);
    std::vector<image::Record> records;
    const auto add = [&](ImageId id, std::span<const std::uint8_t> bytes) {
        Result<image::Signature> signature = image::decode_signature(bytes);
        if (signature) records.push_back({id, std::move(signature).value()});
    };
    const auto scanned = connection.images().for_each_searchable(
        [&](const schema::SearchableImage& picture) {
            if (variant == ingest::kMainVariant)
                return add(picture.id, picture.signature);
            for (const schema::SignatureVariant& other : picture.variants)
                if (other.variant == variant) add(picture.id, other.signature);
        });
    if (!scanned) return scanned.error();
    return records;
}

std::string number(std::optional<double> value) {
    if (!value) return "never";
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.1f", *value);
    return {text.data(), static_cast<std::size_t>(length)};
}

void print(std::span<const LoggedPainting> paintings,
           const std::vector<ReplayRow>& rows,
           std::ostream& out) {
    out << paintings.size() << " paintings\n"
        << "pictures  found  median strokes  median seconds\n";
    for (const ReplayRow& row : rows) {
        std::vector<std::optional<double>> strokes;
        std::vector<std::optional<double>> seconds;
        std::int64_t found = 0;
        for (std::size_t i = 0; i < paintings.size(); ++i) {
            const std::optional<int> needed = row.strokes[i];
            found += needed ? 1 : 0;
            strokes.push_back(needed ? std::optional<double>(*needed) : std::nullopt);
            if (!paintings[i].seconds) continue;
            const auto all = static_cast<double>(paintings[i].strokes.items.size());
            seconds.push_back(
                needed ? std::optional<double>(*paintings[i].seconds * *needed / all)
                       : std::nullopt);
        }
        const std::string timed =
            seconds.empty() ? "not logged" : number(median(std::move(seconds)));
        std::array<char, 96> line{};
        std::snprintf(line.data(),
                      line.size(),
                      "%8lld  %5lld  %14s  %14s\n",
                      static_cast<long long>(row.pictures),
                      static_cast<long long>(found),
                      number(median(std::move(strokes))).c_str(),
                      timed.c_str());
        out << line.data();
    }
}

}  // namespace

std::optional<int> strokes_to_target(const LoggedPainting& painting,
                                     const image::IndexSnapshot& snapshot,
                                     const image::Profile& profile,
                                     int m,
                                     int limit) {
    image::StrokePicture so_far = painting.strokes;
    so_far.items.clear();
    for (const image::Stroke& stroke : painting.strokes.items) {
        so_far.items.push_back(stroke);
        const image::Raster canvas = image::rasterize(so_far);
        const image::Signature signature =
            image::make_signature(canvas.view(), profile.kind);
        const image::Query query = image::make_query(signature, profile, m);
        const auto best = snapshot.search(query, {limit}).matches;
        if (std::ranges::find(best, painting.target, &image::Match::id) != best.end())
            return static_cast<int>(so_far.items.size());
    }
    return {};
}

std::vector<ReplayRow> replay(std::span<const LoggedPainting> paintings,
                              std::vector<image::Record> pictures,
                              const image::Profile& profile,
                              const ReplayOptions& options) {
    std::set<ImageId> targets;
    for (const LoggedPainting& painting : paintings) targets.insert(painting.target);
    std::mt19937_64 random(options.seed);
    image::draw_to_front(random, std::span(pictures), pictures.size());
    const auto others = std::ranges::stable_partition(
        pictures,
        [&](const image::Record& record) { return targets.contains(record.id); });
    const auto target_count = pictures.size() - others.size();

    std::vector<ReplayRow> rows;
    image::Index index({.index_m = options.m});
    std::size_t held = 0;
    for (int size = 1; size <= options.databases; ++size) {
        const std::size_t wanted =
            target_count + others.size() * static_cast<std::size_t>(size) /
                               static_cast<std::size_t>(options.databases);
        index.apply(std::span(pictures).subspan(held, wanted - held), {});
        held = wanted;
        ReplayRow row;
        row.pictures = static_cast<std::int64_t>(wanted);
        for (const LoggedPainting& painting : paintings)
            row.strokes.push_back(strokes_to_target(
                painting, *index.snapshot(), profile, options.m, kScreen));
        rows.push_back(std::move(row));
    }
    return rows;
}

Result<void> replay_database(const ReplayOptions& options, std::ostream& out) {
    auto opened =
        server::Connection::open(options.database, schema::Database::Mode::kReadOnly);
    if (!opened) return opened.error();
    server::Connection& connection = *opened.value();
    const Result<image::Profile> profile =
        ingest::find_profile(connection.profiles(), options.profile);
    if (!profile) return profile.error();
    const auto paintings = read_paintings(connection);
    if (!paintings) return paintings.error();
    if (paintings->empty())
        return Error{ErrorCode::kNotFound,
                     options.database + " has no logged paintings: see POST /feedback"};
    auto pictures = read_pictures(connection, profile.value());
    if (!pictures) return pictures.error();
    print(*paintings,
          replay(*paintings, std::move(pictures).value(), profile.value(), options),
          out);
    return {};
}

}  // namespace haarmony::eval
