#include "ingest/pipeline.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "ingest/bounded_queue.h"
#include "ingest/byte_budget.h"
#include "ingest/file_uri.h"
#include "ingest/film_rows.h"
#include "ingest/prune.h"
#include "ingest/read_file.h"

namespace haarmony::ingest {
namespace {

using Clock = std::chrono::steady_clock;

// How often the observer hears of a run at least; it throttles what it shows.
constexpr std::chrono::milliseconds kTick{100};
// Paths are small: enough that workers do not wait for a folder to be listed.
constexpr std::size_t kJobQueue = 512;
// Readings hold thumbnails: enough that workers do not wait for a commit.
constexpr std::size_t kReadingsPerWorker = 16;

struct Job {
    FoundFile file;
    std::string uri;
    std::optional<schema::KnownFile> known;
    std::vector<FilmRow> key_frames;  // where it was a film
    Need need = Need::kDecode;
};

struct Unchanged {};
struct WalkFailure {
    std::string path;
    std::string reason;
};
struct CatalogueFailure {
    Error error;
};
using Event = std::variant<FileReading, Unchanged, WalkFailure, CatalogueFailure>;

// Reads one file and finds out what it needs. Nothing: it is not there any more.
std::optional<Reading> read_and_describe(const Job& job,
                                         const PictureSteps& steps,
                                         const ReadLimits& limits,
                                         ByteBudget& budget) {
    // The clock is read first: a change during or after the reading is never older.
    const std::int64_t started_ns = now_ns();
    const Result<FileContent> content = read_file(job.file.path, limits, budget);
    if (!content) {
        if (content.error().code == ErrorCode::kNotFound) return std::nullopt;
        return Unreadable{stamp_of(job.file.look, started_ns, {}),
                          content.error().message};
    }
    const std::span<const std::uint8_t> bytes(content->bytes);
    if (job.need == Need::kCompare && job.known) {
        std::string hash = steps.content_hash(bytes);
        if (hash == job.known->stamp.content_hash) {
            return SameContent{stamp_of(content->look, started_ns, std::move(hash))};
        }
    }
    Result<schema::NewImage> image = steps.describe(bytes);
    if (!image) {
        // A failed row always has a reason, even where a foreign decoder gives none.
        const std::string& reason = image.error().message;
        return Undecodable{stamp_of(content->look, started_ns, steps.content_hash(bytes)),
                           reason.empty() ? "cannot be decoded" : reason};
    }
    image->origin = schema::ImageOrigin::kFile;
    image->uri = job.uri;
    image->stamp =
        stamp_of(content->look, started_ns, std::move(image->stamp.content_hash));
    return Described{std::move(*image)};
}

class Run {
  public:
    Run(const PipelineOptions& options,
        Catalogue& catalogue,
        const MakePictureSteps& make_steps,
        Observer& observer,
        const std::atomic<bool>& stop)
        : options_(options),
          catalogue_(catalogue),
          make_steps_(make_steps),
          observer_(observer),
          stop_(stop),
          budget_(options.file_bytes),
          events_(kReadingsPerWorker * static_cast<std::size_t>(options.jobs)),
          writer_(catalogue, observer, options.restore) {}

    Report operator()() {
        std::thread counter;
        if (options_.count_ahead) counter = std::thread([this] { count(); });
        std::thread walker([this] { walk_all(); });
        std::vector<std::thread> workers;
        workers_left_ = options_.jobs;
        for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });

        Report report;
        report.outcome = write_all();
        if (!report.outcome) {
            aborted_ = true;
            jobs_.close();
            events_.close();
        }
        walker.join();
        for (std::thread& worker : workers) worker.join();
        if (counter.joinable()) counter.join();

        report.paths_reached = summary_.reached.size();
        if (report.outcome && options_.prune && !stop_) report.outcome = prune();
        report.stopped = stop_;
        report.tally = writer_.tally();
        return report;
    }

  private:
    bool keep_going() const { return !stop_ && !aborted_; }

    void count() {
        std::int64_t found = 0;
        const WalkSummary summary =
            walk(options_.paths,
                 options_.walk,
                 {[&found](const FoundFile&) { return ++found, true; },
                  [](const std::string&, const Error&) { return true; },
                  [this] { return keep_going() && !walked_; }});
        if (summary.finished) total_ = found;
    }

    void walk_all() {
        std::int64_t found = 0;
        summary_ = walk(options_.paths,
                        options_.walk,
                        {[&](FoundFile file) { return ++found, take(std::move(file)); },
                         [this](const std::string& path, const Error& error) {
                             return events_.push(WalkFailure{path, error.message});
                         },
                         [this] { return keep_going(); }});
        walked_ = true;
        if (summary_.finished && options_.count_ahead) total_ = found;
        jobs_.close();
    }

    bool take(FoundFile file) {
        std::string uri = file_uri(file.path);
        Result<std::optional<schema::KnownFile>> known = catalogue_.look_up(uri);
        if (!known) {
            events_.push(CatalogueFailure{known.error()});
            return false;
        }
        Result<std::vector<FilmRow>> key_frames = std::vector<FilmRow>();
        if (options_.walk.films) key_frames = catalogue_.look_up_key_frames(uri);
        if (!key_frames) {
            events_.push(CatalogueFailure{key_frames.error()});
            return false;
        }
        const Need need = film_need(*known, *key_frames, file.look, options_.restore);
        if (need == Need::kNothing) return events_.push(Unchanged{});
        return jobs_.push({std::move(file),
                           std::move(uri),
                           std::move(*known),
                           std::move(*key_frames),
                           need});
    }

    void work() {
        const PictureSteps steps = make_steps_();
        const ReadLimits limits{.max_bytes = options_.max_file_bytes};
        while (std::optional<Job> job = jobs_.pop()) {
            if (!keep_going()) continue;
            const std::optional<OpenFilm> film =
                options_.walk.films ? open_film(job->file.path) : std::nullopt;
            std::optional<Reading> reading =
                film ? read_film(*film,
                                 job->uri,
                                 job->key_frames,
                                 job->need,
                                 steps.film,
                                 [this] { return keep_going(); })
                     : read_and_describe(*job, steps, limits, budget_);
            if (!reading) continue;
            // Ctrl-C reaches the decoders' children as well: what fails while the run is
            // being stopped may not be the file's fault. The next run tells.
            if (stop_ && std::holds_alternative<Undecodable>(*reading)) continue;
            events_.push(FileReading{std::move(job->file.path),
                                     std::move(job->uri),
                                     std::move(*reading),
                                     film.has_value(),
                                     !job->key_frames.empty()});
        }
        if (--workers_left_ == 0) events_.close();
    }

    Result<void> write_all() {
        Clock::time_point next_tick = Clock::now();
        while (!events_.exhausted()) {
            const Clock::time_point wake =
                writer_.batch().empty() ? next_tick
                                        : std::min(next_tick, writer_.batch().deadline());
            std::optional<Event> event = events_.pop_until(wake);
            const Clock::time_point now = Clock::now();
            Result<void> written =
                event ? take(std::move(*event), now) : writer_.write_if_due(now);
            if (!written) return written;
            if (now >= next_tick) {
                observer_.progress(writer_.tally(), total_);
                next_tick = now + kTick;
            }
        }
        return writer_.write();
    }

    Result<void> take(Event event, Clock::time_point now) {
        if (auto* reading = std::get_if<FileReading>(&event)) {
            return writer_.take(std::move(*reading), now);
        }
        if (auto* failure = std::get_if<CatalogueFailure>(&event)) {
            Result<void> written = writer_.write();
            return written ? Result<void>(std::move(failure->error)) : written;
        }
        if (auto* failure = std::get_if<WalkFailure>(&event)) {
            writer_.report_failure(failure->path, failure->reason);
        } else {
            writer_.count_unchanged();
        }
        return writer_.write_if_due(now);
    }

    Result<void> prune() {
        for (const std::string& root : summary_.reached) {
            Pruned pruned =
                prune_below(catalogue_, root, [this] { return keep_going(); });
            writer_.count_pruned(pruned.rows);
            if (!pruned.outcome) return std::move(pruned.outcome);
        }
        return {};
    }

    const PipelineOptions& options_;
    Catalogue& catalogue_;
    const MakePictureSteps& make_steps_;
    Observer& observer_;
    const std::atomic<bool>& stop_;

    ByteBudget budget_;
    BoundedQueue<Job> jobs_{kJobQueue};
    BoundedQueue<Event> events_;
    Writer writer_;
    WalkSummary summary_;
    std::atomic<bool> aborted_ = false;
    std::atomic<bool> walked_ = false;
    std::atomic<std::int64_t> total_ = -1;
    std::atomic<int> workers_left_ = 0;
};

}  // namespace

Report run(const PipelineOptions& options,
           Catalogue& catalogue,
           const MakePictureSteps& make_steps,
           Observer& observer,
           const std::atomic<bool>& stop) {
    assert(options.jobs >= 1);
    return Run(options, catalogue, make_steps, observer, stop)();
}

}  // namespace haarmony::ingest
