// Random collections under threads: readers search what they find published, in every way
// there is, while one thread changes the collection and another merges.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/engine/image/random_collection.h"
#include "tests/engine/image/scattered_executor.h"

namespace haarmony::image {
namespace {

using Answers = std::vector<std::vector<Match>>;  // [question]

// A collection's changes, what is asked all the time, and all answers there can be.
struct Script {
    IndexOptions options;
    std::vector<Change> changes;
    std::vector<Question> questions;
    std::vector<Answers> after;  // [change]
};

Script write_script(unsigned seed) {
    RandomCollection collection(seed);
    Script script{collection.options(), {}, {}, {}};
    std::vector<Pictures> states;
    for (int i = 0; i < collection.changes(); ++i) {
        script.changes.push_back(collection.change());
        states.push_back(collection.live());
    }
    for (int i = 0; i < 3; ++i) {
        script.questions.push_back(collection.question());
        script.questions.back().limit = 1 + collection.below(30);
    }
    for (const Pictures& state : states) {
        Answers answers;
        for (const Question& question : script.questions) {
            answers.push_back(rank_literally(state, question));
            auto& best = answers.back();
            best.resize(std::min(best.size(), std::size_t(question.limit)));
        }
        script.after.push_back(std::move(answers));
    }
    return script;
}

// Every question is put to the one snapshot in another way.
Answers ask(const IndexSnapshot& snapshot, const std::vector<Question>& questions) {
    ScatteredExecutor executor(2);
    Answers answers;
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const Question& question = questions[i];
        const std::optional<IdSet> only = id_set_of(question);
        SearchScope scope{question.limit, only ? &*only : nullptr};
        if (i == 0) {
            std::vector<Match> all = snapshot.score_all(query_of(question), scope.only);
            std::ranges::sort(all, better);
            all.resize(std::min(all.size(), std::size_t(question.limit)));
            answers.push_back(std::move(all));
            continue;
        }
        if (i == 1) scope.executor = &executor;
        answers.push_back(snapshot.search(query_of(question), scope).matches);
    }
    return answers;
}

// What the threads tell each other.
struct Progress {
    std::atomic<bool> done = false;
    std::atomic<int> reads = 0;
    std::atomic<int> strays = 0;  // answers of no state, or of one that was over
    std::atomic<int> merges = 0;
};

void read(const Index& index, const Script& script, Progress& progress) {
    std::size_t at = 0;
    while (!progress.done) {
        const Answers answers = ask(*index.snapshot(), script.questions);
        while (at < script.after.size() && script.after[at] != answers) ++at;
        if (at == script.after.size()) {
            ++progress.strays;
            return;
        }
        ++progress.reads;
    }
}

void merge(Index& index, Progress& progress) {
    while (!progress.done) {
        if (index.merge_once()) {
            ++progress.merges;
        } else {
            std::this_thread::yield();
        }
    }
}

// Some answers of every state, unless a reader has given up or the machine is very slow.
void write(Index& index, const Script& script, Progress& progress) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    for (std::size_t i = 1; i < script.changes.size(); ++i) {
        const int before = progress.reads;
        index.apply(script.changes[i].upserts, script.changes[i].removals);
        while (progress.reads < before + 2 && progress.strays == 0 &&
               std::chrono::steady_clock::now() < deadline) {
            std::this_thread::yield();
        }
    }
}

// Those whose changes leave many small segments: there is always something to merge.
std::vector<unsigned> scattered_seeds(std::size_t count) {
    std::vector<unsigned> seeds;
    for (unsigned seed = 1; seeds.size() < count; ++seed) {
        if (RandomCollection(seed).scattered()) seeds.push_back(seed);
    }
    return seeds;
}

TEST(RandomIndexThreads, EverySnapshotAnswersAllQuestionsOfOneState) {
    for (const unsigned seed : scattered_seeds(4)) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const Script script = write_script(seed);
        Index index(script.options);
        index.apply(script.changes[0].upserts, script.changes[0].removals);
        Progress progress;
        {
            std::vector<std::jthread> threads;
            threads.reserve(3);
            for (int reader = 0; reader < 2; ++reader)
                threads.emplace_back([&] { read(index, script, progress); });
            threads.emplace_back([&] { merge(index, progress); });
            write(index, script, progress);
            progress.done = true;
        }
        EXPECT_EQ(progress.strays, 0);
        EXPECT_GE(progress.reads, int(2 * (script.changes.size() - 1)));
        EXPECT_GT(progress.merges, 0);
        EXPECT_EQ(ask(*index.snapshot(), script.questions), script.after.back());
    }
}

}  // namespace
}  // namespace haarmony::image
