// What the handlers share. It outlives every request.
#pragma once

#include <cstdint>

#include "server/app/cluster_overview.h"
#include "server/app/curve_service.h"
#include "server/app/duplicate_groups.h"
#include "server/app/frame_search.h"
#include "server/app/image_service.h"
#include "server/app/job_runner.h"
#include "server/app/media_roots.h"
#include "server/app/video_service.h"

namespace haarmony::server {

struct Context {
    ImageService& images;
    JobRunner& jobs;
    DuplicateGroups& duplicates;
    ClusterOverview& clusters;
    CurveService& curves;
    VideoService& videos;
    FrameSearch& frames;
    MediaRoots media_roots;
    bool allow_url_fetch = false;
    std::uint64_t max_body = std::uint64_t{64} << 20;  // bytes of a picture or of JSON
    std::uint64_t max_video_body = std::uint64_t{1} << 30;
};

}  // namespace haarmony::server
