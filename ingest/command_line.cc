#include "ingest/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <map>
#include <thread>
#include <utility>

namespace haarmony::ingest {
namespace {

constexpr const char* kDescription =
    "Finds the pictures in files and folders and records them in a Haarmony database:\n"
    "signature, thumbnail, size. Files that are unchanged since the last run are "
    "skipped;\n"
    "a run that was killed goes on where it was.";

constexpr const char* kFooter =
    "A candidate is a file with the extension or the first bytes of a picture; a file "
    "that\n"
    "is itself a PATH is always one. Links to files are read, links to folders are not\n"
    "followed unless they are a PATH, special files are ignored. A file that vanishes\n"
    "while it is waiting for its turn is passed over.\n"
    "\n"
    "With --videos films are candidates as well, by extension or first bytes. A film is "
    "one\n"
    "seen; each of its key frames has a row of its own, FILE#t=SECONDS, and is counted "
    "as\n"
    "added, updated or, where the film has changed and has it no more, pruned. All of a\n"
    "film is committed at once. An unchanged film is skipped.\n"
    "\n"
    "GLOB: without a '/' it is compared with the name of each file and folder below a "
    "PATH,\n"
    "with one with the path below that PATH. '*' is any run of bytes but '/', '**' any "
    "run,\n"
    "'**/' any folders or none, '?' one byte, [a-z] and [!a-z] one byte of (not of) a "
    "set,\n"
    "'\\x' is x itself. A final '/' wants a folder. An excluded folder is not entered; "
    "a\n"
    "PATH that is a folder is never excluded. What is recorded already stays.\n"
    "\n"
    "Each failure is a line 'failed: PATH: REASON' on stderr. The last line of stdout "
    "is\n"
    "'done: seen=N added=N updated=N skipped=N failed=N pruned=N seconds=S'. A PATH "
    "that\n"
    "does not exist or cannot be read is a failure.\n"
    "\n"
    "Exit status: 0 all is well; 1 some files failed, the rest is stored; 2 wrong "
    "usage;\n"
    "3 could not run (no PATH could be used, the database cannot be opened or written;\n"
    "what was committed before stays); 130 and 143 after Ctrl-C and SIGTERM, with\n"
    "everything done so far committed. A second Ctrl-C ends it at once.";

constexpr int kMostJobs = 256;

// CLI11 takes "[a,b]" among the values of a list apart; as a path "./[a,b]" is the same.
void protect_bracketed_paths(std::vector<std::string>& arguments) {
    bool options_ended = false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool is_glob = !options_ended && i > 0 && arguments[i - 1] == "--exclude";
        std::string& argument = arguments[i];
        if (argument == "--") options_ended = true;
        if (!is_glob && argument.starts_with('[') && argument.ends_with(']')) {
            argument.insert(0, "./");
        }
    }
}

Error usage_error(const std::string& message) {
    return {ErrorCode::kInvalidArgument, message, {}};
}

}  // namespace

Result<CommandLine> parse_command_line(std::vector<std::string> arguments) {
    CommandLine line;
    std::vector<std::string> globs;
    line.pipeline.jobs =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostJobs);

    CLI::App app(kDescription, "haarmony-ingest");
    app.footer(kFooter);
    app.option_defaults()->always_capture_default();
    app.add_option("PATH", line.pipeline.paths, "files and folders")->required();
    app.add_option("--db", line.database, "the database file; made when there is none")
        ->required()
        ->capture_default_str()
        ->type_name("FILE");
    app.add_option("--jobs", line.pipeline.jobs, "pictures decoded at a time")
        ->check(CLI::Range(1, kMostJobs))
        ->type_name("N");
    app.add_option("--max-file-bytes",
                   line.pipeline.max_file_bytes,
                   "a larger picture is a failure")
        ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max()))
        ->type_name("N");
    app.add_flag(
        "--videos", line.pipeline.walk.films, "record the key frames of films, too");
    app.add_option("--max-key-frames",
                   line.most_key_frames,
                   "of a film, evenly spaced where it has more")
        ->check(CLI::Range(1, kLargestMostKeyFrames))
        ->type_name("N");
    app.add_flag(
        "--prune",
        line.pipeline.prune,
        "drop the rows below each PATH whose file is gone (not below a PATH that "
        "is gone itself)");
    app.add_flag("--restore",
                 line.pipeline.restore,
                 "bring back pictures that were deleted through the API");
    app.add_option(
           "--exclude", globs, "pass over what matches; may be given several times")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("GLOB");
    std::string progress = "auto";
    app.add_option("--progress",
                   progress,
                   "auto: a bar on a terminal, else plain lines; json: one object a line")
        ->check(CLI::IsMember({"auto", "plain", "none", "json"}))
        ->type_name("auto|plain|none|json");
    app.set_version_flag("--version", "haarmony-ingest " HAARMONY_VERSION);

    protect_bracketed_paths(arguments);
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        line.answer = app.help();
        return line;
    } catch (const CLI::CallForVersion& version) {
        line.answer = std::string(version.what()) + '\n';
        return line;
    } catch (const CLI::ParseError& error) {
        return usage_error(error.what());
    }

    if (line.database.empty()) return usage_error("--db: is empty");
    for (std::string& glob : globs) {
        if (glob.empty()) return usage_error("--exclude: is empty");
        line.pipeline.walk.exclude.emplace_back(std::move(glob));
    }
    for (const std::string& path : line.pipeline.paths) {
        if (path.empty()) return usage_error("PATH: is empty");
    }
    static const std::map<std::string, ProgressMode> kModes = {
        {"plain", ProgressMode::kPlain},
        {"none", ProgressMode::kNone},
        {"json", ProgressMode::kJson}};
    if (const auto mode = kModes.find(progress); mode != kModes.end()) {
        line.progress = mode->second;
    }
    return line;
}

}  // namespace haarmony::ingest
