#include "tests/eval/frame_collection.h"

#include <cassert>
#include <utility>

#include "engine/video/memory_clip.h"
#include "server/app/frame_signatures.h"
#include "server/app/query_picture.h"
#include "tests/eval/video_sizes.h"

namespace haarmony::eval {
namespace {

bool always() { return true; }

schema::Video row_of(const VideoClip& clip) {
    schema::Video row;
    row.revision = "0000000000000000";
    row.name = clip.name;
    row.width = clip.format.width;
    row.height = clip.format.height;
    row.frames = static_cast<std::int64_t>(clip.frames.size());
    row.rate_numerator = clip.format.rate.numerator;
    row.rate_denominator = clip.format.rate.denominator;
    row.indexed = true;
    return row;
}

}  // namespace

FrameCollection::FrameCollection(std::unique_ptr<TemporaryFolder> folder,
                                 schema::Database database)
    : folder_(std::move(folder)), database_(std::move(database)) {}

Result<std::unique_ptr<FrameCollection>> FrameCollection::make() {
    auto folder = std::make_unique<TemporaryFolder>();
    const std::string path = folder->file("frames.sqlite");
    auto database =
        schema::Database::open(path, schema::Database::Mode::kReadWriteCreate);
    if (!database) return database.error();
    std::unique_ptr<FrameCollection> made(
        new FrameCollection(std::move(folder), *std::move(database)));
    made->search_ = std::make_unique<server::FrameSearch>(path, image::kMaxCoefficients);
    return made;
}

Result<std::int64_t> FrameCollection::add(const VideoClip& clip) {
    assert(!clip.frames.empty());
    const auto tree = built_in_memory(clip, 0);
    if (!tree) return tree.error();
    auto shots = server::find_shots(**tree, always);
    if (!shots) return shots.error();
    const auto signatures = server::frame_signatures(**tree, 0, always);
    if (!signatures) return signatures.error();
    const auto row = videos_.add(
        row_of(clip), *signatures, [](const schema::Video&) { return Result<void>(); });
    if (!row) return row.error();
    signatures_ += static_cast<std::int64_t>(signatures->size());
    kept_.emplace(row->id, Kept{(*tree)->shape(), *std::move(shots)});
    return row->id;
}

Result<FoundFrames> FrameCollection::best(const RgbPicture& picture,
                                          const image::Profile& profile,
                                          bool misregistered) {
    server::LookOptions look;
    look.kinds = {profile.kind};
    look.misregistered = misregistered;
    const server::QueryPicture query =
        server::look_at(picture.view(), picture.width, picture.height, look);
    server::PlanOptions options;
    options.profiles = {profile};
    const auto matches = search_->search(query, options, 1);
    if (!matches) return matches.error();
    if (matches->frames.empty())
        return Error{ErrorCode::kNotFound, "no frame can be found"};
    const server::FoundFrame& first = matches->frames.front();
    const Kept& kept = kept_.at(first.video.id);
    FoundFrames found;
    found.video = first.video.id;
    found.frames = kept.shape.frames_of({first.time_level, first.node});
    found.shot = kept.shots[static_cast<std::size_t>(found.frames.first)];
    found.distance = first.match.distance;
    return found;
}

std::int64_t FrameCollection::count_shots() const {
    std::int64_t shots = 0;
    for (const auto& [video, kept] : kept_) shots += kept.shots.back() + 1;
    return shots;
}

}  // namespace haarmony::eval
