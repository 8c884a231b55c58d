// haarmony-eval: measures how well and how fast the search works on one's own pictures, draws
// the figures of the curves, and measures multiresolution video, and searches inside of it, on
// one's own clips.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/app/thread_executor.h"
#include "tests/eval/copies.h"
#include "tests/eval/curves.h"
#include "tests/eval/figures.h"
#include "tests/eval/frame_retrieval.h"
#include "tests/eval/replay.h"
#include "tests/eval/speed_report.h"
#include "tests/eval/train_profile.h"
#include "tests/eval/video_report.h"

namespace {

using haarmony::eval::CopiesOptions;
using haarmony::eval::FiguresOptions;

int failed(const haarmony::Error& error) {
    std::cerr << error.message << '\n';
    return 3;
}

int run_copies(const CopiesOptions& options) {
    const auto report = haarmony::eval::measure_copies(options);
    if (!report) return failed(report.error());
    std::cout << to_text(*report);
    return 0;
}

int write_and_list(const std::vector<haarmony::eval::OutputFile>& files,
                   const std::string& folder) {
    const auto written = haarmony::eval::write_files(files, folder);
    if (!written) return failed(written.error());
    for (const auto& file : files) std::cout << folder << '/' << file.name << '\n';
    return 0;
}

struct FiguresCommand {
    std::string images;
    std::string out;
    int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    FiguresOptions options;
};

int run_figures(const FiguresCommand& command) {
    const auto source = haarmony::eval::folder_source(command.images);
    if (!source) return failed(source.error());
    haarmony::server::ThreadExecutor threads(command.threads - 1);
    const auto files = haarmony::eval::make_figures(
        *source, command.options, threads, [](const std::string& line) {
            std::cerr << line << '\n';
        });
    if (!files) return failed(files.error());
    return write_and_list(*files, command.out);
}

struct SpeedCommand {
    std::string out;
    haarmony::eval::SpeedOptions options;
};

int run_speed(SpeedCommand command) {
    std::ranges::sort(command.options.images);
    haarmony::server::ThreadExecutor threads(command.options.threads - 1);
    const auto report = haarmony::eval::measure_speed(
        command.options, threads, [](const std::string& line) {
            std::cerr << line << '\n';
        });
    if (!report) return failed(report.error());
    std::cout << to_text(*report);
    if (!command.out.empty()) {
        const int status = write_and_list(speed_files(*report), command.out);
        if (status != 0) return status;
    }
    return report->mismatches() == 0 ? 0 : 1;
}

struct VideoCommand {
    std::string out;
    haarmony::eval::VideoOptions options;
};

int run_video(const VideoCommand& command) {
    const auto report = haarmony::eval::measure_video(
        command.options, [](const std::string& line) { std::cerr << line << '\n'; });
    if (!report) return failed(report.error());
    std::cout << to_text(*report);
    const int status = write_and_list(video_files(*report), command.out);
    if (status != 0) return status;
    return report->broken_bounds() == 0 ? 0 : 1;
}

struct FramesCommand {
    std::string out;
    haarmony::eval::FrameRetrievalOptions options;
};

int run_frames(const FramesCommand& command) {
    const auto measured = haarmony::eval::measure_frames(
        command.options, [](const std::string& line) { std::cerr << line << '\n'; });
    if (!measured) return failed(measured.error());
    std::cout << to_text(*measured);
    return command.out.empty()
               ? 0
               : write_and_list(frame_retrieval_files(*measured), command.out);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures how well the search works on a folder of pictures"};
    app.require_subcommand(1);

    CopiesOptions copies_options;
    CLI::App* copies = app.add_subcommand(
        "copies", "ranks of the originals of poor copies and of coarse paintings");
    copies->add_option("--images", copies_options.folder, "folder of pictures")
        ->required();
    copies
        ->add_option(
            "--queries", copies_options.queries, "how many pictures to query for")
        ->check(CLI::Range(1, 1'000'000));

    FiguresCommand command;
    CLI::App* figures = app.add_subcommand(
        "figures", "the figures and tables of the evaluation, as a page and CSV");
    figures->add_option("--images", command.images, "folder of pictures")->required();
    figures->add_option("--out", command.out, "folder for index.html and the tables")
        ->required();
    figures
        ->add_option(
            "--queries", command.options.queries, "how many pictures to query for")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    figures->add_option("--seed", command.options.seed, "of everything random")
        ->capture_default_str();
    figures->add_option("--threads", command.threads, "how many at a time")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();

    std::string curves_out;
    CLI::App* curves = app.add_subcommand(
        "curves", "the figures of chapter 3 with our own curves, as a page and CSV");
    curves->add_option("--out", curves_out, "folder for curves.html and the table")
        ->required();

    haarmony::eval::TrainProfileOptions training;
    CLI::App* train = app.add_subcommand(
        "train",
        "fits a profile to training pairs and stores it; exit code 1: it would be worse");
    train->add_option("--db", training.database, "the database")->required();
    train->add_option("--pairs", training.pairs, "JSON lines, as GET /feedback/export")
        ->required();
    train->add_option("--profile", training.profile, "its name")->required();
    train->add_option("--base", training.base, "the profile to start from")
        ->capture_default_str();
    train->add_option("--kind", training.kind, "only pairs of this kind");
    train->add_option("--seed", training.seed, "of everything random")
        ->capture_default_str();
    train->add_flag("--replace-worse",
                    training.replace_worse,
                    "stores it whatever the profile of that name is worth");

    haarmony::eval::ReplayOptions replay_options;
    CLI::App* replay = app.add_subcommand(
        "replay", "paints the logged paintings again: strokes until the target is found");
    replay->add_option("--db", replay_options.database, "the database")->required();
    replay->add_option("--profile", replay_options.profile, "how to compare")
        ->capture_default_str();
    replay->add_option("--m", replay_options.m, "coefficients per channel")
        ->check(CLI::Range(1, haarmony::image::kMaxCoefficients))
        ->capture_default_str();
    replay->add_option("--databases", replay_options.databases, "nested sizes")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    replay->add_option("--seed", replay_options.seed, "of who is in which database")
        ->capture_default_str();

    SpeedCommand speed_command;
    speed_command.options.threads =
        static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    CLI::App* speed = app.add_subcommand("speed",
                                         "times queries beside the plain algorithm and "
                                         "brute force; exit code 1: an answer "
                                         "was wrong");
    speed
        ->add_option("--images",
                     speed_command.options.images,
                     "how many synthetic pictures: one number or several, with commas")
        ->required()
        ->delimiter(',')
        ->check(CLI::Range(haarmony::eval::kMostSpeedQueries, 100'000'000));
    speed->add_option("--photos",
                      speed_command.options.photos,
                      "folder of pictures that they are cut from; else generated ones");
    speed->add_option("--out", speed_command.out, "folder for speed.html and the tables");
    speed->add_option("--queries", speed_command.options.queries, "queries of each kind")
        ->check(CLI::Range(1, haarmony::eval::kMostSpeedQueries))
        ->capture_default_str();
    speed->add_option("--seed", speed_command.options.seed, "of everything random")
        ->capture_default_str();
    speed->add_option("--cache",
                      speed_command.options.cache,
                      "file that keeps the pictures between runs");
    speed
        ->add_option("--threads",
                     speed_command.options.threads,
                     "for making pictures, checking answers, and the most to search with")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();

    VideoCommand video_command;
    CLI::App* video = app.add_subcommand(
        "video",
        "sizes, bounds and speed of multiresolution video; exit code 1: a lossy clip is "
        "farther from its source than it says");
    video->add_option("--clips", video_command.options.clips, "folder of clips")
        ->required();
    video->add_option("--out", video_command.out, "folder for the tables")->required();
    video
        ->add_option(
            "--frames", video_command.options.frames, "of each clip, the first ones")
        ->check(CLI::Range(1, 1 << 16))
        ->capture_default_str();
    video
        ->add_option("--questions",
                     video_command.options.speed.questions,
                     "frames drawn by lot for each time")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    video
        ->add_option(
            "--rounds", video_command.options.speed.rounds, "of builds and encodings")
        ->check(CLI::Range(1, 1'000))
        ->capture_default_str();

    FramesCommand frames_command;
    CLI::App* frames = app.add_subcommand(
        "frames", "how often poor copies of frames find their own shot and clip first");
    frames->add_option("--clips", frames_command.options.clips, "folder of clips")
        ->required();
    frames->add_option("--out", frames_command.out, "folder for the table");
    frames
        ->add_option(
            "--queries", frames_command.options.queries, "frames to query for, of all")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    frames
        ->add_option(
            "--frames", frames_command.options.frames, "of each clip, the first ones")
        ->check(CLI::Range(1, 1 << 16))
        ->capture_default_str();
    frames->add_option("--seed", frames_command.options.seed, "of everything random")
        ->capture_default_str();

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (train->parsed())
        return haarmony::eval::train_profile(training, std::cout, std::cerr);
    if (curves->parsed())
        return write_and_list(haarmony::eval::make_curve_figures(), curves_out);
    if (video->parsed()) return run_video(video_command);
    if (frames->parsed()) return run_frames(frames_command);
    if (speed->parsed()) return run_speed(std::move(speed_command));
    if (replay->parsed()) {
        const auto replayed = haarmony::eval::replay_database(replay_options, std::cout);
        return replayed ? 0 : failed(replayed.error());
    }
    return copies->parsed() ? run_copies(copies_options) : run_figures(command);
}
