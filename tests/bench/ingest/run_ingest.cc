#include "tests/bench/ingest/run_ingest.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "ingest/catalogue.h"
#include "ingest/describe.h"
#include "ingest/pipeline.h"
#include "tests/bench/ingest/contenders.h"

namespace haarmony::bench {
namespace {

struct Silent final : ingest::Observer {
    void failed(const std::string&, const std::string&) override {}
    void progress(const ingest::Tally&, std::int64_t) override {}
};

class ScratchFolder {
  public:
    ScratchFolder()
        : path_((std::filesystem::temp_directory_path() / "haarmony-bench-XXXXXX")
                    .string()) {
        if (::mkdtemp(path_.data()) == nullptr) give_up(path_ + " cannot be made");
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace

IngestRun run_ingest(const std::string& folder) {
    const ScratchFolder scratch;
    const auto begin = std::chrono::steady_clock::now();
    const double begin_processor = process_seconds();
    auto catalogue = ingest::StoredCatalogue::open(scratch.path() + "/bench.db");
    if (!catalogue) give_up(catalogue.error().message);
    ingest::PipelineOptions options;
    options.paths = {folder};
    Silent silent;
    const std::atomic<bool> stop = false;
    const ingest::Report report = ingest::run(
        options,
        **catalogue,
        ingest::picture_steps({ingest::kMainKind.begin(), ingest::kMainKind.end()},
                              ingest::kMostKeyFrames),
        silent,
        stop);
    if (!report.outcome) give_up(report.outcome.error().message);
    IngestRun run;
    run.added = report.tally.added;
    run.failed = report.tally.failed;
    run.processor_seconds = process_seconds() - begin_processor;
    run.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return run;
}

}  // namespace haarmony::bench
