#include "server/app/frame_search.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "engine/image/aspect.h"
#include "engine/image/signature_codec.h"
#include "ingest/variant.h"
#include "server/app/log_value.h"

namespace haarmony::server {
namespace {

constexpr int kPage = 4'096;

Result<std::vector<schema::Video>> all_videos(schema::VideoStore& videos) {
    return videos.list(std::numeric_limits<int>::max(), 0);
}

Result<void> refuse_other_kinds(const PlanOptions& options) {
    for (const image::Profile& profile : options.profiles)
        if (profile.kind != image::SignatureKind{})
            return Error{ErrorCode::kConflict,
                         "frames have signatures of the kind " +
                             image::kind_name(image::SignatureKind{}) +
                             " alone, and the profile '" + profile.name +
                             "' compares another one",
                         "profile"};
    return {};
}

}  // namespace

FrameSearch::FrameSearch(const std::string& database_path, int index_m)
    : readers_([database_path] {
          return Connection::open(database_path, schema::Database::Mode::kReadOnly);
      }),
      index_({.index_m = index_m}) {}

Result<void> FrameSearch::take_new(schema::VideoStore& videos, Places& places) {
    const auto rows = all_videos(videos);
    if (!rows) return rows.error();
    std::map<std::int64_t, std::int32_t> aspects;
    for (const schema::Video& video : *rows)
        aspects[video.id] = image::log_aspect(static_cast<int>(video.width),
                                              static_cast<int>(video.height));
    for (;;) {
        const auto page = videos.frames_after(last_, kPage);
        if (!page) return page.error();
        std::vector<image::Record> records;
        for (const schema::FrameSignature& frame : *page) {
            last_ = frame.id;
            places[frame.id] = {frame.video, frame.time_level, frame.node, frame.shot};
            const auto signature = image::decode_signature(frame.signature);
            if (signature) {
                records.push_back({ImageId{frame.id}, *signature, aspects[frame.video]});
            } else {
                spdlog::warn("event=frame_damaged id={} reason={}",
                             frame.id,
                             log_value(signature.error().message));
            }
        }
        index_.apply(records, {});
        if (page->size() < kPage) return {};
    }
}

Result<void> FrameSearch::drop_gone(schema::VideoStore& videos, Places& places) {
    const auto there = videos.frame_ids();
    if (!there) return there.error();
    std::vector<ImageId> gone;
    for (auto place = places.begin(); place != places.end();) {
        if (std::binary_search(there->begin(), there->end(), place->first)) {
            ++place;
            continue;
        }
        gone.push_back(ImageId{place->first});
        place = places.erase(place);
    }
    index_.apply({}, gone);
    return {};
}

Result<FrameSearch::Snapshot> FrameSearch::follow() {
    auto connection = readers_.lend();
    if (!connection) return connection.error();
    schema::VideoStore& videos = (*connection)->videos();
    const std::lock_guard lock(mutex_);
    const auto version = videos.frames_version();
    if (!version) return version.error();
    const auto known = static_cast<std::int64_t>(places_->size());
    if (version->count != known || version->last > last_) {
        auto places = std::make_shared<Places>(*places_);
        Result<void> done = take_new(videos, *places);
        if (done) done = drop_gone(videos, *places);
        if (!done) return done.error();
        // Few and rare, so nobody waits long; searches go on in the older snapshot.
        while (index_.merge_once()) {
        }
        places_ = std::move(places);
    }
    return Snapshot{index_.snapshot(), places_};
}

Result<std::int64_t> FrameSearch::count() {
    auto connection = readers_.lend();
    if (!connection) return connection.error();
    const auto version = (*connection)->videos().frames_version();
    if (!version) return version.error();
    return version->count;
}

Result<FrameMatches> FrameSearch::search(const QueryPicture& picture,
                                         const PlanOptions& options,
                                         int limit) {
    if (const auto kinds = refuse_other_kinds(options); !kinds) return kinds.error();
    const auto snapshot = follow();
    if (!snapshot) return snapshot.error();
    auto plan = SearchPlan::make(
        picture, options, {{ingest::kMainVariant, snapshot->index}}, index_.index_m());
    if (!plan) return plan.error();
    auto connection = readers_.lend();
    if (!connection) return connection.error();
    FrameMatches matches{*std::move(plan), {}, 0, {}};
    for (int wanted = limit;; wanted *= 2) {
        const auto start = std::chrono::steady_clock::now();
        const Candidates candidates = matches.plan.best(wanted, nullptr, nullptr);
        matches.ranking += std::chrono::steady_clock::now() - start;
        matches.searched = candidates.searched;
        matches.frames.clear();
        std::set<std::pair<std::int64_t, std::int64_t>> shots;
        std::map<std::int64_t, std::optional<schema::Video>> rows;
        for (const Candidate& candidate : candidates.best) {
            const auto place = snapshot->places->find(to_int(candidate.id));
            if (place == snapshot->places->end()) continue;
            const auto& [id, where] = *place;
            if (!shots.emplace(where.video, where.shot).second) continue;
            auto row = rows.find(where.video);
            if (row == rows.end()) {
                auto video = (*connection)->videos().get(where.video);
                if (!video && video.error().code != ErrorCode::kNotFound)
                    return video.error();
                row =
                    rows.emplace(where.video,
                                 video ? std::optional(*std::move(video)) : std::nullopt)
                        .first;
            }
            // Removed since the snapshot was taken.
            if (!row->second) continue;
            // In this order: a frame that is still there has its place in the video as that
            // was read, also if frames are appended meanwhile.
            const auto there = (*connection)->videos().has_frame(id);
            if (!there) return there.error();
            if (!*there) continue;
            matches.frames.push_back(
                {id, *row->second, where.time_level, where.node, candidate});
            if (static_cast<int>(matches.frames.size()) == limit) return matches;
        }
        if (candidates.exhausted || wanted > std::numeric_limits<int>::max() / 2)
            return matches;
    }
}

}  // namespace haarmony::server
