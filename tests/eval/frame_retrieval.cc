#include "tests/eval/frame_retrieval.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "tests/eval/csv.h"
#include "tests/eval/distortions.h"
#include "tests/eval/frame_collection.h"
#include "tests/eval/text_table.h"

namespace haarmony::eval {
namespace {

constexpr std::string_view kClips = "clips";
constexpr std::string_view kFilm = "one film";

// Copies and paintings; what turns, mirrors or frames a picture has options of its own.
constexpr std::array<const char*, 11> kPoor = {"identity",
                                               "JPEG quality 10",
                                               "thumbnail 32 px",
                                               "scan simulation",
                                               "brightness x 1.3",
                                               "colour shift 0.2",
                                               "grey",
                                               "crop 5 % a side",
                                               "crop 10 % a side",
                                               "translation 5 %",
                                               "painted 12 x 12"};

// A frame of one of the clips.
struct Place {
    std::size_t clip = 0;
    std::size_t frame = 0;
};

// As many as are asked for, or all, in an order that a seed decides.
std::vector<Place> drawn_by_lot(const std::vector<VideoClip>& clips,
                                const FrameRetrievalOptions& options) {
    std::vector<Place> places;
    for (std::size_t clip = 0; clip < clips.size(); ++clip)
        for (std::size_t frame = 0; frame < clips[clip].frames.size(); ++frame)
            places.push_back({clip, frame});
    Random random(options.seed);
    const std::size_t wanted =
        std::min(places.size(), static_cast<std::size_t>(options.queries));
    for (std::size_t i = 0; i < wanted; ++i) {
        const int left = static_cast<int>(places.size() - i);
        std::swap(places[i], places[i + static_cast<std::size_t>(random.below(left))]);
    }
    places.resize(wanted);
    return places;
}

video::Picture to_picture(const RgbPicture& rgb) {
    video::Picture picture(rgb.width, rgb.height);
    for (std::size_t p = 0; p < picture.pixels.size(); ++p)
        picture.pixels[p] = {rgb.rgb[3 * p], rgb.rgb[3 * p + 1], rgb.rgb[3 * p + 2], 255};
    return picture;
}

// With frames of exactly that size.
VideoClip scaled(const VideoClip& clip, int width, int height) {
    VideoClip small{clip.name, clip.kind, {width, height, clip.format.rate}, {}};
    for (const video::Picture& frame : clip.frames)
        small.frames.push_back(to_picture(resize(to_rgb(frame.view()), width, height)));
    return small;
}

VideoClip shrunk(const VideoClip& clip, std::int32_t side) {
    const std::int32_t longer = std::max(clip.format.width, clip.format.height);
    const double scale = std::min(1.0, static_cast<double>(side) / longer);
    const auto length = [scale](std::int32_t of) {
        return std::max(1, static_cast<int>(std::lround(of * scale)));
    };
    return scaled(clip, length(clip.format.width), length(clip.format.height));
}

// A collection, and where in it the frames of each clip are.
struct Arrangement {
    std::string_view name;
    std::unique_ptr<FrameCollection> collection;
    std::vector<std::int64_t> videos;        // of each clip
    std::vector<std::int64_t> first_frames;  // of each clip, in its video
    std::vector<std::int64_t> lengths;

    [[nodiscard]] bool in_clip(const FoundFrames& found, std::size_t clip) const {
        return found.video == videos[clip] && found.frames.first >= first_frames[clip] &&
               found.frames.end <= first_frames[clip] + lengths[clip];
    }
    [[nodiscard]] bool in_shot(const FoundFrames& found, const Place& place) const {
        const auto frame =
            static_cast<std::size_t>(first_frames[place.clip]) + place.frame;
        return in_clip(found, place.clip) &&
               found.shot == collection->shots(found.video)[frame];
    }
};

Result<Arrangement> clips_apart(const std::vector<VideoClip>& clips) {
    auto collection = FrameCollection::make();
    if (!collection) return collection.error();
    Arrangement apart{kClips, *std::move(collection), {}, {}, {}};
    for (const VideoClip& clip : clips) {
        const auto video = apart.collection->add(clip);
        if (!video) return video.error();
        apart.videos.push_back(*video);
        apart.first_frames.push_back(0);
        apart.lengths.push_back(static_cast<std::int64_t>(clip.frames.size()));
    }
    return apart;
}

Result<Arrangement> one_film(const std::vector<VideoClip>& clips) {
    auto collection = FrameCollection::make();
    if (!collection) return collection.error();
    Arrangement film{kFilm, *std::move(collection), {}, {}, {}};
    VideoClip all{std::string(kFilm), VideoKind::kNatural, clips.front().format, {}};
    for (const VideoClip& clip : clips) {
        film.first_frames.push_back(static_cast<std::int64_t>(all.frames.size()));
        film.lengths.push_back(static_cast<std::int64_t>(clip.frames.size()));
        VideoClip part = scaled(clip, all.format.width, all.format.height);
        std::move(part.frames.begin(), part.frames.end(), std::back_inserter(all.frames));
    }
    const auto video = film.collection->add(all);
    if (!video) return video.error();
    film.videos.assign(clips.size(), *video);
    return film;
}

std::int64_t cuts_found(const Arrangement& film) {
    const auto& shots = film.collection->shots(film.videos.front());
    std::int64_t cuts = 0;
    for (const std::int64_t first : film.first_frames) {
        const auto frame = static_cast<std::size_t>(first);
        cuts += frame > 0 && shots[frame] != shots[frame - 1] ? 1 : 0;
    }
    return cuts;
}

// The same queries for every collection and profile.
std::vector<RgbPicture> poor_copies(const std::vector<VideoClip>& clips,
                                    const std::vector<Place>& places,
                                    const Distortion& distortion,
                                    std::uint64_t seed) {
    std::vector<RgbPicture> copies;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Random random(gallery::mix_seeds(seed, i));
        const video::Picture& frame = clips[places[i].clip].frames[places[i].frame];
        copies.push_back(to_rgb(distortion.apply(to_rgb(frame.view()), random).view()));
    }
    return copies;
}

Result<FrameRetrievalRow> ask(const Arrangement& where,
                              const std::vector<Place>& places,
                              const std::vector<RgbPicture>& queries,
                              const image::Profile& profile,
                              bool misregistered) {
    FrameRetrievalRow row;
    row.collection = where.name;
    row.profile = profile.name;
    row.misregistered = misregistered;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto found = where.collection->best(queries[i], profile, misregistered);
        if (!found) return found.error();
        ++row.queries;
        row.own_clip += where.in_clip(*found, places[i].clip) ? 1 : 0;
        row.own_shot += where.in_shot(*found, places[i]) ? 1 : 0;
    }
    return row;
}

Result<std::vector<image::Profile>> profiles_of(const FrameRetrievalOptions& options) {
    std::vector<image::Profile> profiles;
    for (const std::string& name : options.profiles) {
        auto profile = image::built_in_profile(name);
        if (!profile)
            return Error{
                ErrorCode::kInvalidArgument, "no profile '" + name + "'", "profile"};
        profiles.push_back(*std::move(profile));
    }
    return profiles;
}

}  // namespace

const FrameRetrievalRow& FrameRetrieval::row(const std::string& collection,
                                             const std::string& distortion,
                                             const std::string& profile) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
        return row.collection == collection && row.distortion == distortion &&
               row.profile == profile && !row.misregistered;
    });
    assert(found != rows.end());
    return *found;
}

Result<FrameRetrieval> measure_frames(
    const std::vector<VideoClip>& clips,
    const FrameRetrievalOptions& options,
    const std::function<void(const std::string&)>& progress) {
    assert(!clips.empty());
    const auto profiles = profiles_of(options);
    if (!profiles) return profiles.error();
    std::vector<VideoClip> small;
    for (const VideoClip& clip : clips) small.push_back(shrunk(clip, options.side));
    const auto apart = clips_apart(small);
    if (!apart) return apart.error();
    const auto film = one_film(small);
    if (!film) return film.error();
    small.clear();

    FrameRetrieval measured;
    measured.clips = static_cast<std::int64_t>(clips.size());
    for (const VideoClip& clip : clips)
        measured.frames += static_cast<std::int64_t>(clip.frames.size());
    measured.signatures = apart->collection->count_signatures();
    measured.clip_shots = apart->collection->count_shots();
    measured.film_shots = film->collection->count_shots();
    measured.film_cuts = cuts_found(*film);
    const std::vector<Place> places = drawn_by_lot(clips, options);
    for (const char* name : kPoor) {
        progress(name);
        const std::vector<RgbPicture> queries =
            poor_copies(clips, places, distortion(name), options.seed);
        for (const Arrangement* where : {&*apart, &*film}) {
            for (const image::Profile& profile : *profiles) {
                for (const bool misregistered : {false, true}) {
                    auto row = ask(*where, places, queries, profile, misregistered);
                    if (!row) return row.error();
                    row->distortion = name;
                    measured.rows.push_back(*std::move(row));
                }
            }
        }
    }
    return measured;
}

Result<FrameRetrieval> measure_frames(
    const FrameRetrievalOptions& options,
    const std::function<void(const std::string&)>& progress) {
    const auto sources = folder_clips(options.clips);
    if (!sources) return sources.error();
    if (sources->empty())
        return Error{ErrorCode::kNotFound, options.clips + ": no clip in it"};
    std::vector<VideoClip> clips;
    for (const VideoClipSource& source : *sources) {
        progress(source.name);
        auto clip = source.load(options.frames);
        if (!clip) return clip.error();
        clips.push_back(*std::move(clip));
    }
    return measure_frames(clips, options, progress);
}

std::string to_text(const FrameRetrieval& measured) {
    std::string text = std::to_string(measured.clips) + " clips, " +
                       std::to_string(measured.frames) + " frames, " +
                       std::to_string(measured.signatures) + " signatures, " +
                       std::to_string(measured.clip_shots) + " shots; as one film " +
                       std::to_string(measured.film_shots) + " shots, " +
                       std::to_string(measured.film_cuts) + " of " +
                       std::to_string(measured.clips - 1) + " cuts found\n\n";
    TextTable table({"collection",
                     "poor copy",
                     "profile",
                     "misregistered",
                     "queries",
                     "own shot",
                     "own clip"},
                    4);
    for (const FrameRetrievalRow& row : measured.rows) {
        table.add({row.collection,
                   row.distortion,
                   row.profile,
                   row.misregistered ? "true" : "false",
                   std::to_string(row.queries),
                   std::to_string(row.own_shot),
                   std::to_string(row.own_clip)});
    }
    return text + table.text();
}

std::vector<OutputFile> frame_retrieval_files(const FrameRetrieval& measured) {
    CsvTable table({"collection",
                    "poor_copy",
                    "profile",
                    "misregistered",
                    "queries",
                    "own_shot",
                    "own_clip"});
    for (const FrameRetrievalRow& row : measured.rows) {
        table.add({row.collection,
                   row.distortion,
                   row.profile,
                   row.misregistered ? 1 : 0,
                   row.queries,
                   row.own_shot,
                   row.own_clip});
    }
    return {{"frame_retrieval.csv", table.text()}};
}

}  // namespace haarmony::eval
