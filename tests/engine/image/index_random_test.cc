// The whole search against the oracle, on many small random collections. A few hundred by
// default; HAARMONY_RANDOM_COLLECTIONS asks for more, as the sanitizers' presets do, and
// HAARMONY_RANDOM_SEED for those from another seed on: 1 and the seed of a failure repeat it.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "engine/image/best_of.h"
#include "engine/image/symmetry.h"
#include "tests/engine/image/random_collection.h"
#include "tests/engine/image/random_signatures.h"
#include "tests/engine/image/scattered_executor.h"

namespace haarmony::image {
namespace {

constexpr unsigned kShares = 8;  // of the seeds, each a test of its own

unsigned number_from_environment(const char* name, unsigned otherwise) {
    const char* text = std::getenv(name);
    if (text == nullptr) return otherwise;
    unsigned number = 0;
    const char* const end = text + std::strlen(text);
    const auto [rest, error] = std::from_chars(text, end, number);
    if (error != std::errc{} || rest != end)
        ADD_FAILURE() << name << ": '" << text << "' is no number";
    return number;
}

// A snapshot, and what it must answer for ever.
struct Kept {
    std::shared_ptr<const IndexSnapshot> snapshot;
    Question question;
    std::vector<Match> ranking;
};

// One collection from its first picture to the end, with questions in between.
class Trial {
  public:
    explicit Trial(unsigned seed)
        : seed_(seed), collection_(seed), index_(collection_.options()) {}

    void run() {
        for (int changes = collection_.changes(); changes > 0; --changes) {
            const Change change = collection_.change();
            index_.apply(change.upserts, change.removals);
            merge();
            ASSERT_EQ(index_.snapshot()->stats().images,
                      std::int64_t(collection_.live().size()))
                << text();
            const bool is_last = changes == 1;
            const int questions = is_last ? 3 : collection_.below(3);
            for (int i = 0; i < questions; ++i) {
                ask();
                if (testing::Test::HasFatalFailure()) return;
            }
            if (collection_.one_in(4)) ask_turned();
            if (testing::Test::HasFatalFailure()) return;
        }
        for (const Kept& kept : kept_)
            expect(*kept.snapshot, kept.question, kept.ranking);
    }

  private:
    [[nodiscard]] std::string text() const {
        return "seed " + std::to_string(seed_) + ": " + collection_.text();
    }

    void merge() {
        int most = std::array{0, 0, 1, 100}[std::size_t(collection_.below(4))];
        if (collection_.scattered() && !collection_.one_in(20)) most = 0;
        while (most-- > 0 && index_.merge_once()) {
        }
    }

    void ask() {
        Kept asked{index_.snapshot(), collection_.question(), {}};
        asked.ranking = rank_literally(collection_.live(), asked.question);
        expect(*asked.snapshot, asked.question, asked.ranking);
        if (collection_.one_in(6)) kept_.push_back(std::move(asked));
    }

    void expect(const IndexSnapshot& snapshot,
                const Question& question,
                std::vector<Match> ranking) {
        const Query query = query_of(question);
        const std::optional<IdSet> only = id_set_of(question);
        const IdSet* const filter = only ? &*only : nullptr;
        if (collection_.one_in(3)) {
            std::vector<Match> all = snapshot.score_all(query, filter);
            std::ranges::sort(all, better);
            ASSERT_EQ(all, ranking) << text() << "\nall scores: " << question.text();
        }
        const auto searched = std::int64_t(ranking.size());
        ranking.resize(std::min(ranking.size(), std::size_t(question.limit)));
        // Threads are dear where they are watched, and no other way of asking needs as many.
        const bool helped = collection_.one_in(8);
        for (const bool exhaustive : {false, true}) {
            SearchScope scope{question.limit, filter, helped ? &executor_ : nullptr};
            scope.exhaustive = exhaustive;
            const SearchResult found = snapshot.search(query, scope);
            ASSERT_EQ(found.matches, ranking)
                << text() << "\nexhaustive " << exhaustive << ", helped " << helped
                << ": " << question.text();
            ASSERT_EQ(found.searched, searched) << text() << '\n' << question.text();
        }
    }

    // The same picture in several positions, each found at its best.
    void ask_turned() {
        const Question upright = collection_.question();
        const auto snapshot = index_.snapshot();
        std::vector<Query> queries;
        std::map<std::int64_t, BestMatch> best;
        for (const Symmetry symmetry : kSymmetries) {
            if (!queries.empty() && collection_.one_in(2)) continue;
            Question turned = upright;
            turned.signature = transformed(upright.signature, symmetry);
            for (const Match& match : rank_literally(collection_.live(), turned)) {
                const Score distance = match.score + left_out(turned);
                const BestMatch here{match.id, distance, queries.size(), match.score};
                const auto [at, is_new] = best.try_emplace(to_int(match.id), here);
                if (!is_new && distance < at->second.distance) at->second = here;
            }
            queries.push_back(query_of(turned));
        }
        std::vector<BestMatch> expected;
        expected.reserve(best.size());
        for (const auto& [_, match] : best) expected.push_back(match);
        std::ranges::stable_sort(expected, {}, &BestMatch::distance);
        expected.resize(std::min(expected.size(), std::size_t(upright.limit)));

        std::vector<Way> ways;
        ways.reserve(queries.size());
        for (const Query& query : queries) ways.push_back({snapshot.get(), &query});
        const std::optional<IdSet> only = id_set_of(upright);
        const BestResult found =
            search_best(ways, {upright.limit, only ? &*only : nullptr});
        ASSERT_EQ(found.matches, expected)
            << text() << "\nin " << ways.size() << " positions: " << upright.text();
        ASSERT_EQ(found.searched, std::int64_t(best.size())) << text();
    }

    const unsigned seed_;
    RandomCollection collection_;
    Index index_;
    ScatteredExecutor executor_{3};
    std::vector<Kept> kept_;
};

class IndexOfRandomPictures : public testing::TestWithParam<unsigned> {
  protected:
    ~IndexOfRandomPictures() override { hwy::SetSupportedTargetsForTest(0); }
};

// The instruction sets that this machine has take turns, plain C++ among them.
TEST_P(IndexOfRandomPictures, AnswersEveryQuestionAsTheOracleDoes) {
    const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    const unsigned count = number_from_environment("HAARMONY_RANDOM_COLLECTIONS", 400);
    const unsigned first = number_from_environment("HAARMONY_RANDOM_SEED", 1);
    for (unsigned i = GetParam(); i < count; i += kShares) {
        const unsigned seed = first + i;
        hwy::SetSupportedTargetsForTest(targets[seed / kShares % targets.size()]);
        Trial(seed).run();
        if (HasFatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(Share, IndexOfRandomPictures, testing::Range(0U, kShares));

// The oracle and the metric say the same, term by term.
TEST(LiteralRanking, IsThatOfTheMetric) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        RandomCollection collection(seed);
        (void)collection.change();
        Reference reference;
        for (const auto& [id, record] : collection.live()) {
            if (reference.size() == 30) break;
            reference[id] = {record.signature, record.log_aspect};
        }
        Pictures pictures = collection.live();
        std::erase_if(pictures, [&](const auto& entry) {
            return !reference.contains(entry.first);
        });
        Question question = collection.question();
        question.limit = 30;
        const SearchResult expected =
            search_literally(reference,
                             question.signature,
                             question.profile,
                             question.m,
                             {.limit = question.limit,
                              .log_aspect = question.log_aspect,
                              .aspect_weight = question.aspect_weight,
                              .only = question.only});
        EXPECT_EQ(rank_literally(pictures, question), expected.matches)
            << "seed " << seed << ", " << question.text();
    }
}

}  // namespace
}  // namespace haarmony::image
