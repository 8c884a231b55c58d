#include "server/api/status.h"

#include <nlohmann/json.hpp>

#include "ingest/decode.h"
#include "ingest/sniff.h"
#include "schema/database.h"
#include "server/api/image_id.h"
#include "server/http/json.h"
#include "server/version.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

http::Response fresh(const json& members) {
    http::Response response = http::json_response(200, members);
    response.headers["Cache-Control"] = "no-store";
    return response;
}

}  // namespace

Reply get_health(const Context& /*context*/, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    return fresh({{"status", "ok"}});
}

Reply get_readiness(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    if (!context.images.ready())
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    return fresh({{"status", "ready"}});
}

Reply get_status(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto status = context.images.status();
    if (!status) return status.error();
    const auto videos = context.videos.count();
    if (!videos) return videos.error();
    const auto frames = context.frames.count();
    if (!frames) return frames.error();
    const image::IndexStats& index = status->index;
    const double bytes_per_image =
        index.images == 0
            ? 0.0
            : static_cast<double>(index.bytes) / static_cast<double>(index.images);
    return fresh({{"images", status->rows.indexed},
                  {"videos", *videos},
                  {"frames", *frames},
                  {"failed", status->rows.failed},
                  {"deleted", status->rows.deleted},
                  {"searchable", index.images},
                  {"damaged_signatures", status->damaged},
                  {"tombstones", index.tombstones},
                  {"segments", index.segments},
                  {"tail", index.tail},
                  {"index_bytes", index.bytes},
                  {"bytes_per_image", bytes_per_image},
                  {"index_m", status->index_m},
                  {"sequence", status->sequence},
                  {"snapshot_sequence", status->snapshot_sequence.value_or(0)},
                  {"began_with_snapshot", status->began_with_snapshot ? 1 : 0},
                  {"ready", status->ready ? 1 : 0}});
}

Reply get_version(const Context& /*context*/, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    json formats = json::array();
    for (const ingest::FormatDescription& format : ingest::formats())
        formats.push_back({{"name", format.name}, {"media_type", format.media_type}});
    return fresh({{"version", kVersion},
                  {"api", kApiVersion},
                  {"schema", schema::current_version()},
                  {"decode_rule", ingest::kDecodeRule},
                  {"formats", std::move(formats)}});
}

}  // namespace haarmony::server
