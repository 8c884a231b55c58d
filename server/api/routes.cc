#include "server/api/routes.h"

#include <array>
#include <utility>

#include "server/api/clusters.h"
#include "server/api/curve_library.h"
#include "server/api/curves.h"
#include "server/api/duplicates.h"
#include "server/api/feedback.h"
#include "server/api/image_media.h"
#include "server/api/image_upload.h"
#include "server/api/images.h"
#include "server/api/jobs.h"
#include "server/api/openapi.h"
#include "server/api/profiles.h"
#include "server/api/query.h"
#include "server/api/status.h"
#include "server/api/surfaces.h"
#include "server/api/training.h"
#include "server/api/video_compose.h"
#include "server/api/video_export.h"
#include "server/api/video_frame.h"
#include "server/api/video_panorama.h"
#include "server/api/video_play.h"
#include "server/api/video_thumbnails.h"
#include "server/api/video_timeline.h"
#include "server/api/video_upload.h"
#include "server/api/videos.h"

namespace haarmony::server {
namespace {

using http::Cost;

// Costly is what may decode a picture, looks at the whole collection, or writes and so may
// have to wait for another writer; those wait in a queue of their own.
constexpr std::array kRoutes{
    Route{"POST",
          "/query",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_query,
          cost_of_query},
    Route{"GET", "/query", Cost::kCheap, Body::kNone, false, get_query, cost_of_query},
    Route{"POST", "/query/batch", Cost::kCostly, Body::kPicture, false, post_query_batch},
    Route{"GET", "/images", Cost::kCheap, Body::kNone, false, list_images},
    Route{"POST", "/images", Cost::kCostly, Body::kPicture, false, post_image},
    Route{"GET", "/images/{id}", Cost::kCheap, Body::kNone, false, get_image},
    Route{"DELETE", "/images/{id}", Cost::kCostly, Body::kNone, false, delete_image},
    Route{"GET",
          "/images/{id}/thumbnail",
          Cost::kCheap,
          Body::kNone,
          false,
          get_thumbnail},
    Route{"GET", "/images/{id}/original", Cost::kCheap, Body::kNone, false, get_original},
    Route{"GET",
          "/images/{id}/signature",
          Cost::kCheap,
          Body::kNone,
          false,
          get_signature},
    Route{"GET", "/images/{id}/similar", Cost::kCheap, Body::kNone, false, get_similar},
    Route{"GET", "/profiles", Cost::kCheap, Body::kNone, false, list_profiles},
    Route{"GET", "/profiles/{name}", Cost::kCheap, Body::kNone, false, get_profile},
    Route{"PUT", "/profiles/{name}", Cost::kCostly, Body::kPicture, false, put_profile},
    Route{"DELETE",
          "/profiles/{name}",
          Cost::kCostly,
          Body::kNone,
          false,
          delete_profile},
    Route{"GET", "/clusters", Cost::kCostly, Body::kNone, false, get_clusters},
    Route{"GET", "/duplicates", Cost::kCostly, Body::kNone, false, list_duplicates},
    Route{"POST",
          "/duplicates/ignore",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_ignored_duplicates},
    Route{"POST", "/jobs", Cost::kCostly, Body::kPicture, false, post_job},
    Route{"GET", "/jobs", Cost::kCheap, Body::kNone, false, list_jobs},
    Route{"GET", "/jobs/{id}", Cost::kCheap, Body::kNone, false, get_job},
    Route{"DELETE", "/jobs/{id}", Cost::kCostly, Body::kNone, false, delete_job},
    Route{"GET", "/jobs/{id}/events", Cost::kCheap, Body::kNone, false, get_job_events},
    Route{"POST",
          "/profiles/{name}/train",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_training},
    Route{"GET", "/feedback", Cost::kCheap, Body::kNone, false, list_feedback},
    Route{"POST", "/feedback", Cost::kCostly, Body::kPicture, false, post_feedback},
    Route{"DELETE", "/feedback/{id}", Cost::kCostly, Body::kNone, false, delete_feedback},
    Route{"GET", "/feedback/export", Cost::kCheap, Body::kNone, false, export_feedback},
    Route{"POST",
          "/curve/decompose",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_decompose,
          cost_of_curve},
    Route{"POST",
          "/curve/reconstruct",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_reconstruct,
          cost_of_curve},
    Route{"POST",
          "/curve/smooth",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_smooth,
          cost_of_curve},
    Route{"POST",
          "/curve/edit",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_curve_edit,
          cost_of_curve},
    Route{"POST",
          "/curve/fit",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_fit,
          cost_of_curve},
    Route{"POST",
          "/curve/approximate",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_approximate,
          cost_of_curve},
    Route{"POST",
          "/curve/evaluate",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_evaluate,
          cost_of_curve},
    Route{"POST",
          "/curve/character",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_character,
          cost_of_curve},
    Route{"GET", "/curve/characters", Cost::kCheap, Body::kNone, false, list_characters},
    Route{"GET",
          "/curve/characters/{name}",
          Cost::kCheap,
          Body::kNone,
          false,
          get_character},
    Route{"PUT",
          "/curve/characters/{name}",
          Cost::kCostly,
          Body::kPicture,
          false,
          put_character},
    Route{"DELETE",
          "/curve/characters/{name}",
          Cost::kCostly,
          Body::kNone,
          false,
          delete_character},
    Route{"POST", "/curve/match", Cost::kCostly, Body::kPicture, false, post_match},
    Route{"GET", "/curve/strokes", Cost::kCheap, Body::kNone, false, list_strokes},
    Route{"GET", "/curve/strokes/{name}", Cost::kCheap, Body::kNone, false, get_stroke},
    Route{"PUT",
          "/curve/strokes/{name}",
          Cost::kCostly,
          Body::kPicture,
          false,
          put_stroke},
    Route{"DELETE",
          "/curve/strokes/{name}",
          Cost::kCostly,
          Body::kNone,
          false,
          delete_stroke},
    Route{"POST",
          "/surface/decompose",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_surface_decompose,
          cost_of_curve},
    Route{"POST",
          "/surface/reconstruct",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_surface_reconstruct,
          cost_of_curve},
    Route{"POST",
          "/surface/edit",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_surface_edit,
          cost_of_curve},
    Route{"GET", "/videos", Cost::kCheap, Body::kNone, false, list_videos},
    Route{"POST", "/videos", Cost::kCostly, Body::kVideo, false, post_video},
    Route{"GET", "/videos/{id}", Cost::kCheap, Body::kNone, false, get_video},
    Route{"DELETE", "/videos/{id}", Cost::kCostly, Body::kNone, false, delete_video},
    Route{"POST",
          "/videos/compose",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_composition},
    Route{"POST", "/videos/{id}/frames", Cost::kCostly, Body::kVideo, false, post_frames},
    Route{"GET", "/videos/{id}/export", Cost::kCostly, Body::kNone, false, get_export},
    Route{"GET",
          "/videos/{id}/thumbnails.vtt",
          Cost::kCheap,
          Body::kNone,
          false,
          get_thumbnail_track},
    Route{"GET",
          "/videos/{id}/thumbnails.jpg",
          Cost::kCostly,
          Body::kNone,
          false,
          get_thumbnail_sprite},
    Route{"GET", "/video/timeline", Cost::kCostly, Body::kNone, false, get_timeline},
    Route{"GET", "/video/panorama", Cost::kCostly, Body::kNone, false, get_panorama},
    Route{"GET", "/video/play", Cost::kCheap, Body::kNone, false, get_play},
    Route{"GET",
          "/video/frame",
          Cost::kCostly,
          Body::kNone,
          false,
          get_frame,
          nullptr,
          cost_of_frame},
    Route{"POST",
          "/video/frame",
          Cost::kCostly,
          Body::kPicture,
          false,
          post_frame,
          nullptr,
          cost_of_frame},
    Route{"GET", "/healthz", Cost::kInstant, Body::kNone, true, get_health},
    Route{"GET", "/readyz", Cost::kInstant, Body::kNone, true, get_readiness},
    Route{"GET", "/status", Cost::kCheap, Body::kNone, false, get_status},
    Route{"GET", "/version", Cost::kCheap, Body::kNone, false, get_version},
    Route{"GET", "/openapi.json", Cost::kCheap, Body::kNone, false, get_openapi},
};

std::uint64_t body_limit(const Context& context, Body body) {
    switch (body) {
        case Body::kNone:
            return 0;
        case Body::kPicture:
            return context.max_body;
        case Body::kVideo:
            break;
    }
    return context.max_video_body;
}

}  // namespace

std::span<const Route> routes() { return kRoutes; }

void add_routes(const Context& context, http::Router& router) {
    for (const Route& route : kRoutes) {
        http::RouteOptions options;
        options.cost = route.cost;
        options.body_limit = body_limit(context, route.body);
        options.open = route.open;
        options.cost_of = route.cost_of;
        if (route.cost_in != nullptr)
            options.cost_of = [&context,
                               cost = route.cost_in](const http::Request& request) {
                return cost(context, request);
            };
        router.add(route.method,
                   route.pattern,
                   options,
                   [&context, handler = route.handler](const http::Request& request) {
                       Reply reply = handler(context, request);
                       return reply ? *std::move(reply)
                                    : http::to_response(reply.problem(), request);
                   });
    }
}

}  // namespace haarmony::server
