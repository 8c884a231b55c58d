#include "tests/eval/video_report.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tests/eval/csv.h"
#include "tests/eval/text_table.h"
#include "tests/eval/video_clip_art.h"
#include "tests/eval/video_clips.h"

namespace haarmony::eval {
namespace {

std::string missed(const std::string& name,
                   const std::string& what,
                   double reached,
                   double target) {
    return name + ": " + what + " " + number(reached, 3) + ", target " +
           number(target, 3);
}

std::string kilobytes(std::uint64_t bytes) {
    return number(static_cast<double>(bytes) / 1000, 0);
}

std::string shape_of(const VideoSizes& sizes) {
    return std::to_string(sizes.width) + "x" + std::to_string(sizes.height) + "x" +
           std::to_string(sizes.frames);
}

std::string sizes_text(const VideoReport& report) {
    TextTable table({"clip",
                     "size",
                     "paper kB",
                     "memory kB",
                     "mrv kB",
                     "raw kB",
                     "FFV1 kB",
                     "x264 qp 0 kB",
                     "x264 crf 23 intra kB",
                     "memory/raw",
                     "mrv/FFV1"},
                    2);
    for (const VideoSizes& sizes : report.sizes) {
        table.add({sizes.name,
                   shape_of(sizes),
                   kilobytes(sizes.paper),
                   kilobytes(sizes.memory),
                   kilobytes(sizes.file),
                   kilobytes(sizes.raw),
                   kilobytes(sizes.ffv1),
                   kilobytes(sizes.x264_lossless),
                   kilobytes(sizes.x264_intra),
                   number(sizes.memory_ratio(), 3),
                   number(sizes.file_ratio(), 3)});
    }
    return table.text();
}

std::string bounds_text(const VideoReport& report) {
    TextTable table(
        {"clip", "delta", "worst single frame", "worst average", "memory/raw"}, 1);
    for (const VideoBound& bound : report.bounds) {
        table.add({bound.name,
                   std::to_string(bound.delta),
                   number(bound.worst_leaf, 4),
                   number(bound.worst_coarse, 4),
                   number(bound.memory_ratio, 3)});
    }
    return table.text();
}

std::string speed_text(const VideoReport& report) {
    TextTable table({"clip", "name", "beside", "Mpixel/s", "x", "deviation", "target"},
                    3);
    for (const VideoSpeed& speed : report.speed) {
        table.add({speed.name,
                   speed.what,
                   speed.beside,
                   number(speed.pixels_a_second * 1e-6, 1),
                   number(speed.ratio.median, 2),
                   number(speed.ratio.deviation, 2),
                   !speed.has_target() ? "-"
                   : speed.met()       ? "met"
                                       : "missed"});
    }
    return table.text();
}

// One clip at a time is in memory.
Result<void> measure_clip(const VideoClip& clip,
                          const VideoOptions& options,
                          VideoReport& report) {
    auto sizes = measure_video_sizes(clip);
    if (!sizes) return sizes.error();
    report.sizes.push_back(*std::move(sizes));
    if (clip.kind == VideoKind::kGenerated) return {};
    const auto speed = measure_video_speed(clip, options.speed);
    if (!speed) return speed.error();
    report.speed.insert(report.speed.end(), speed->begin(), speed->end());
    if (clip.kind != VideoKind::kNatural) return {};
    const auto bounds = measure_video_bounds(clip, options.deltas);
    if (!bounds) return bounds.error();
    report.bounds.insert(report.bounds.end(), bounds->begin(), bounds->end());
    return {};
}

}  // namespace

int VideoReport::broken_bounds() const {
    int broken = 0;
    for (const VideoBound& bound : bounds) broken += bound.held() ? 0 : 1;
    return broken;
}

std::vector<std::string> VideoReport::misses() const {
    std::vector<std::string> lines;
    for (const VideoSizes& size : sizes) {
        const auto memory = memory_target(size.kind);
        if (memory && size.memory_ratio() > *memory) {
            lines.push_back(
                missed(size.name, "memory / raw", size.memory_ratio(), *memory));
        }
        const auto file = file_target(size.kind);
        if (file && size.file_ratio() > *file) {
            lines.push_back(missed(size.name, "mrv / FFV1", size.file_ratio(), *file));
        }
    }
    for (const VideoBound& bound : bounds) {
        if (bound.held()) continue;
        lines.push_back(missed(bound.name,
                               "difference at delta " + std::to_string(bound.delta),
                               std::max(bound.worst_leaf, bound.worst_coarse),
                               bound.delta));
    }
    for (const VideoSpeed& row : speed) {
        if (row.least_pixels_a_second &&
            row.pixels_a_second < *row.least_pixels_a_second) {
            lines.push_back(missed(row.name,
                                   row.what + " Mpixel/s",
                                   row.pixels_a_second * 1e-6,
                                   *row.least_pixels_a_second * 1e-6));
        }
        if (row.least_ratio && row.ratio.median < *row.least_ratio) {
            lines.push_back(missed(row.name,
                                   row.what + " beside " + row.beside + " x",
                                   row.ratio.median,
                                   *row.least_ratio));
        }
    }
    return lines;
}

Result<VideoReport> measure_video(
    const VideoOptions& options,
    const std::function<void(const std::string&)>& progress) {
    assert(options.frames >= 1);
    auto clips = folder_clips(options.clips);
    if (!clips) return clips.error();
    if (clips->empty()) {
        return Error{ErrorCode::kNotFound, options.clips + ": no clip in it"};
    }
    for (VideoClipSource& generated : generated_clips(options.side)) {
        clips->push_back(std::move(generated));
    }
    clips->push_back({"clip-art", [side = options.side](std::int64_t frames) {
                          return Result<VideoClip>(make_clip_art(side, frames));
                      }});
    VideoReport report;
    for (const VideoClipSource& source : *clips) {
        progress(source.name);
        const auto clip = source.load(options.frames);
        if (!clip) return clip.error();
        const auto measured = measure_clip(*clip, options, report);
        if (!measured) return measured.error();
    }
    return report;
}

std::string to_text(const VideoReport& report) {
    std::string text = sizes_text(report) + '\n' + bounds_text(report) + '\n' +
                       speed_text(report) + '\n';
    const std::vector<std::string> misses = report.misses();
    for (const std::string& line : misses) text += "missed: " + line + '\n';
    if (misses.empty()) text += "all targets met\n";
    return text;
}

std::vector<OutputFile> video_files(const VideoReport& report) {
    CsvTable sizes({"clip",
                    "kind",
                    "width",
                    "height",
                    "frames",
                    "paper",
                    "memory",
                    "mrv",
                    "raw",
                    "ffv1",
                    "x264_lossless",
                    "x264_crf23_intra"});
    for (const VideoSizes& size : report.sizes) {
        sizes.add({size.name,
                   video_kind_name(size.kind),
                   size.width,
                   size.height,
                   size.frames,
                   size.paper,
                   size.memory,
                   size.file,
                   size.raw,
                   size.ffv1,
                   size.x264_lossless,
                   size.x264_intra});
    }
    CsvTable bounds({"clip", "delta", "worst_leaf", "worst_coarse", "memory_ratio"});
    for (const VideoBound& bound : report.bounds) {
        bounds.add({bound.name,
                    bound.delta,
                    bound.worst_leaf,
                    bound.worst_coarse,
                    bound.memory_ratio});
    }
    CsvTable speed({"clip",
                    "name",
                    "beside",
                    "pixels_a_second",
                    "ratio",
                    "deviation",
                    "lower_quartile",
                    "upper_quartile",
                    "met"});
    for (const VideoSpeed& row : report.speed) {
        speed.add({row.name,
                   row.what,
                   row.beside,
                   row.pixels_a_second,
                   row.ratio.median,
                   row.ratio.deviation,
                   row.ratio.lower_quartile,
                   row.ratio.upper_quartile,
                   row.met() ? 1 : 0});
    }
    return {{"video_sizes.csv", sizes.text()},
            {"video_bounds.csv", bounds.text()},
            {"video_speed.csv", speed.text()}};
}

}  // namespace haarmony::eval
