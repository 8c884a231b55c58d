#include "tests/eval/speed.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/image/bit_sums.h"
#include "engine/image/index.h"
#include "engine/image/metric.h"
#include "tests/eval/cpu_clock.h"
#include "tests/eval/database.h"
#include "tests/eval/exhaustive_matches.h"
#include "tests/eval/experiment.h"
#include "tests/eval/memory_bandwidth.h"
#include "tests/eval/plain_search.h"
#include "tests/eval/printed_times.h"
#include "tests/eval/speed_collection.h"

namespace haarmony::eval {
namespace {

using Progress = std::function<void(const std::string&)>;

constexpr std::size_t kApplied = 16384;  // records in one call of apply()
constexpr int kBandwidthPasses = 5;
constexpr int kBruteForceQueries = 20;

constexpr std::array kRules = {image::BinRule::kLiteral,
                               image::BinRule::kLog2Plus1,
                               image::BinRule::kLinear};

void measure_popularity(const SmallPhotos& photos,
                        const SyntheticCollection& collection,
                        Executor& executor,
                        SpeedReport& report) {
    std::vector<PackedSignature> of_photos(photos.pictures.size());
    executor.parallel_for(of_photos.size(), [&](std::size_t i) {
        of_photos[i] = pack(image::make_signature(photos.pictures[i].view()));
    });
    for (const SpeedCase& c : kSpeedCases) {
        report.photos.push_back(ListLengths(of_photos, c.m).read_by(of_photos));
        const ListLengths lengths(collection.signatures, c.m);
        for (const SyntheticKind kind : kSyntheticKinds) {
            std::vector<PackedSignature> queries;
            for (const SyntheticQuery& query :
                 collection.queries[static_cast<std::size_t>(kind)]) {
                queries.push_back(query.signature);
            }
            report.synthetic.emplace_back(kind, lengths.read_by(queries));
        }
    }
}

// Short answers are timed several at a time: looking at the clock takes a while itself.
int calls_for(std::int64_t images) { return images < 10'000 ? 4 : 1; }

class Measurement {
  public:
    Measurement(const SpeedOptions& options,
                const SyntheticCollection& collection,
                Executor& executor,
                const Progress& progress,
                SpeedReport& report)
        : queries_(static_cast<std::size_t>(options.queries)),
          threads_(options.threads),
          collection_(collection),
          executor_(executor),
          progress_(progress),
          report_(report) {}

    void run(std::int64_t images) {
        images_ = images;
        signatures_ =
            std::span(collection_.signatures).first(static_cast<std::size_t>(images));
        progress_(std::to_string(images) + " pictures: the index");
        build_index();
        for (const SpeedCase& c : kSpeedCases) measure_case(c);
        progress_(std::to_string(images) + " pictures: cores");
        measure_cores_of(kSpeedCases[1]);
        index_.reset();
        snapshot_.reset();
        progress_(std::to_string(images) + " pictures: brute force");
        measure_brute_force();
    }

  private:
    // The questions of one bin rule and kind, and what the index said.
    struct Asked {
        std::size_t row = 0;  // of the report
        image::Profile profile;
        std::vector<image::Query> queries;
        std::vector<image::SearchResult> answers;
    };

    void build_index();
    void measure_case(const SpeedCase& c);
    void measure_scan(const Asked& asked);
    Asked measure_row(const SpeedCase& c,
                      image::BinRule rule,
                      std::size_t kind,
                      PlainSearch& plain);
    void check(const std::vector<Asked>& asked);
    void check_oracle(const Asked& asked, std::span<const image::Match> first);
    void measure_cores_of(const SpeedCase& c);
    void measure_brute_force();

    std::size_t queries_;
    int threads_;
    const SyntheticCollection& collection_;
    Executor& executor_;
    const Progress& progress_;
    SpeedReport& report_;
    std::int64_t images_ = 0;
    std::span<const PackedSignature> signatures_;
    std::unique_ptr<image::Index> index_;
    std::shared_ptr<const image::IndexSnapshot> snapshot_;
};

void Measurement::build_index() {
    const double start = thread_cpu_ms();
    index_ =
        std::make_unique<image::Index>(image::IndexOptions{kPackedCoefficients, 1024});
    std::vector<image::Record> records;
    for (std::size_t first = 0; first < signatures_.size(); first += kApplied) {
        const std::size_t end = std::min(first + kApplied, signatures_.size());
        records.clear();
        for (std::size_t i = first; i < end; ++i)
            records.push_back({id_of(i), unpack(signatures_[i])});
        index_->apply(records, {});
        while (index_->merge_once()) {
        }
    }
    snapshot_ = index_->snapshot();
    const image::IndexStats stats = snapshot_->stats();
    report_.sizes.push_back(
        {images_,
         static_cast<double>(stats.bytes) / static_cast<double>(stats.images),
         stats.segments,
         (thread_cpu_ms() - start) / 1e3,
         {}});
}

void Measurement::measure_case(const SpeedCase& c) {
    progress_(std::to_string(images_) + " pictures: m = " + std::to_string(c.m));
    std::vector<Asked> asked;
    {
        PlainSearch plain(signatures_, c.m);
        report_.sizes.back().plain_bytes_per_image.emplace_back(
            c.m, static_cast<double>(plain.bytes()) / static_cast<double>(images_));
        for (const image::BinRule rule : kRules) {
            for (std::size_t kind = 0; kind < kSyntheticKinds.size(); ++kind)
                asked.push_back(measure_row(c, rule, kind, plain));
        }
    }
    check(asked);
}

Measurement::Asked Measurement::measure_row(const SpeedCase& c,
                                            image::BinRule rule,
                                            std::size_t kind,
                                            PlainSearch& plain) {
    Asked asked;
    asked.row = report_.rows.size();
    asked.profile = *image::built_in_profile(c.profile);
    asked.profile.bin_rule = rule;
    asked.answers.resize(queries_);
    std::vector<PlainQuery> plain_queries;
    for (std::size_t i = 0; i < queries_; ++i) {
        asked.queries.push_back(image::make_query(
            unpack(collection_.queries[kind][i].signature), asked.profile, c.m));
        plain_queries.push_back(plain_query(asked.queries.back()));
    }
    const auto ask_plain = [&](std::size_t i) {
        // Volatile: what is not used need not be computed.
        [[maybe_unused]] const volatile float best =
            plain.search(plain_queries[i], kSpeedMatches).front().score;
    };
    const auto ask_index = [&](std::size_t i) {
        asked.answers[i] = snapshot_->search(asked.queries[i], {kSpeedMatches});
    };
    SpeedRow row;
    row.images = images_;
    row.m = c.m;
    row.profile = asked.profile.name;
    row.bin_rule = rule;
    row.kind = kSyntheticKinds[kind];
    row.queries = static_cast<int>(queries_);
    row.times = measure_in_turn(queries_, calls_for(images_), ask_plain, ask_index);
    report_.rows.push_back(row);
    for (const image::SearchResult& answer : asked.answers)
        report_.rows.back().effort += answer.effort;
    measure_scan(asked);
    return asked;
}

// What is read of a picture's average and of its own coefficients hangs on the bounds, and
// is not counted: the scan has to read at least its rows.
void Measurement::measure_scan(const Asked& asked) {
    SpeedRow& row = report_.rows[asked.row];
    image::SearchEffort effort;
    const auto scan = [&](std::size_t i) {
        effort =
            snapshot_->search(asked.queries[i], {kSpeedMatches, nullptr, nullptr, true})
                .effort;
    };
    row.scan = measure_alone(queries_, calls_for(images_), scan);
    for (std::size_t i = 0; i < queries_; ++i) {
        scan(i);
        row.scan_bytes += effort.rows * (image::kBlockSlots / 8);
    }
}

void Measurement::measure_cores_of(const SpeedCase& c) {
    const image::Profile profile = *image::built_in_profile(c.profile);
    std::vector<image::Query> queries;
    const auto& near = collection_.queries[std::size_t(SyntheticKind::kNear)];
    for (std::size_t i = 0; i < queries_; ++i)
        queries.push_back(image::make_query(unpack(near[i].signature), profile, c.m));
    for (const CoresRow& row :
         measure_cores(*snapshot_, queries, kSpeedMatches, threads_))
        report_.cores.push_back(row);
}

void Measurement::check(const std::vector<Asked>& asked) {
    std::vector<image::Query> queries;
    for (const Asked& one : asked)
        queries.insert(queries.end(), one.queries.begin(), one.queries.end());
    const auto expected =
        exhaustive_matches(signatures_, queries, kSpeedMatches, executor_);
    for (std::size_t a = 0; a < asked.size(); ++a) {
        const auto answers = std::span(expected).subspan(a * queries_, queries_);
        report_.rows[asked[a].row].mismatches =
            count_mismatches(asked[a].answers, answers, images_);
        check_oracle(asked[a], answers.front());
    }
}

void Measurement::check_oracle(const Asked& asked, std::span<const image::Match> first) {
    const auto kind = static_cast<std::size_t>(report_.rows[asked.row].kind);
    const image::Signature signature =
        unpack(collection_.queries[kind].front().signature);
    const image::Query& query = asked.queries.front();
    for (const image::Match& match : first) {
        const auto place = static_cast<std::size_t>(to_int(match.id) - 1);
        const std::int64_t metric =
            image::metric(signature, unpack(signatures_[place]), asked.profile, query.m);
        if (metric != image::full_distance(query, match.score)) ++report_.oracle_errors;
    }
}

void Measurement::measure_brute_force() {
    const auto count = static_cast<std::size_t>(images_);
    const auto cells = std::span(collection_.cells).first(count);
    const auto histograms = std::span(collection_.histograms).first(count);
    const auto& asked = collection_.queries[std::size_t(SyntheticKind::kNear)];
    const std::size_t queries = std::min<std::size_t>(queries_, kBruteForceQueries);
    const auto measure = [&](Rival rival, std::size_t bytes, const auto& closest) {
        report_.brute_force.push_back(
            {images_,
             rival_name(rival),
             static_cast<int>(queries),
             measure_alone(queries,
                           calls_for(images_),
                           [&](std::size_t i) {
                               [[maybe_unused]] const volatile std::uint32_t best =
                                   closest(asked[i].features).front().place;
                           }),
             static_cast<std::int64_t>(bytes)});
    };
    measure(Rival::kL1Cells, sizeof(CellBytes), [&](const CompactFeatures& query) {
        return closest_l1(query.cells, cells, kSpeedMatches);
    });
    measure(Rival::kL2Cells, sizeof(CellBytes), [&](const CompactFeatures& query) {
        return closest_l2(query.cells, cells, kSpeedMatches);
    });
    measure(
        Rival::kHistogram, sizeof(HistogramCounts), [&](const CompactFeatures& query) {
            return closest_histogram(query.histogram, histograms, kSpeedMatches);
        });
}

Result<Table42> dissertation_table(const SmallPhotos& photos,
                                   std::uint64_t seed,
                                   Executor& executor) {
    PictureSource source;
    for (std::size_t i = 0; i < photos.pictures.size(); ++i)
        source.names.push_back(std::to_string(i));
    source.load = [&](std::size_t i) -> Result<RgbPicture> { return photos.pictures[i]; };
    const auto database = make_database(source, {image::SignatureKind{}}, executor);
    if (!database) return database.error();
    const auto experiment = Experiment::prepare(
        source, *database, seed, static_cast<int>(photos.pictures.size()), executor);
    if (!experiment) return experiment.error();
    return measure_table_4_2(*experiment, kSmallDatabase, kLargeDatabase);
}

}  // namespace

std::int64_t SpeedReport::mismatches() const {
    std::int64_t sum = oracle_errors;
    for (const SpeedRow& row : rows) sum += row.mismatches;
    for (const CoresRow& row : cores) sum += row.mismatches;
    return sum;
}

std::int64_t count_mismatches(std::span<const image::SearchResult> answers,
                              std::span<const std::vector<image::Match>> expected,
                              std::int64_t images) {
    assert(answers.size() == expected.size());
    std::int64_t mismatches = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const bool same =
            answers[i].matches == expected[i] && answers[i].searched == images;
        mismatches += same ? 0 : 1;
    }
    return mismatches;
}

Result<SpeedReport> measure_speed(const SpeedOptions& options,
                                  Executor& executor,
                                  const Progress& progress) {
    assert(!options.images.empty() && std::ranges::is_sorted(options.images));
    assert(options.queries >= 1 && options.queries <= kMostSpeedQueries);
    assert(options.images.front() >= options.queries);
    const auto photos = speed_photos(options, executor);
    if (!photos) return photos.error();
    SpeedReport report;
    report.seed = options.seed;
    report.source = std::to_string(photos->pictures.size()) +
                    (options.photos.empty() ? " generated pictures" : " photos");
    if (options.images.back() >= kLargeDatabase) {
        progress("Table 4.2");
        auto table = dissertation_table(*photos, options.seed, executor);
        if (!table) return table.error();
        report.table_4_2 = std::move(*table);
    }
    const auto collection = speed_collection(options, *photos, executor, progress);
    if (!collection) return collection.error();
    progress("popularity of lists");
    measure_popularity(*photos, *collection, executor, report);
    report.bytes_per_second = memory_bandwidth(options.bandwidth_bytes, kBandwidthPasses);
    Measurement measurement(options, *collection, executor, progress, report);
    for (const std::int64_t images : options.images) measurement.run(images);
    return report;
}

}  // namespace haarmony::eval
