#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "engine/image/index.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

constexpr SignatureShape kShape{.max_count = 10, .max_index = 20, .average_steps = 3};
constexpr int kM = 8;
constexpr int kLimit = 12;

struct Step {
    std::vector<Record> upserts;
    std::vector<ImageId> removals;
    SearchResult expected;  // after this step, from the metric
};

// Every step puts picture 1 at another average, so that no two states look alike.
std::vector<Step> make_steps(const Signature& query, int count) {
    std::mt19937 random(171);
    const Profile profile = *built_in_profile("scanned");
    Reference reference;
    std::vector<Step> steps;
    for (int i = 0; i < count; ++i) {
        Step step;
        Signature marker = query;
        marker.channels[0].average += i;
        step.upserts.push_back({ImageId{1}, marker});
        for (int k = 0; k < 3; ++k) {
            step.upserts.push_back({ImageId{2 + static_cast<int>(random() % 25)},
                                    random_signature(random, kShape)});
            step.removals.push_back(ImageId{2 + static_cast<int>(random() % 25)});
        }
        for (const Record& record : step.upserts) {
            reference[to_int(record.id)] = {record.signature};
        }
        for (const ImageId id : step.removals) reference.erase(to_int(id));
        step.expected =
            search_literally(reference, query, profile, kM, {.limit = kLimit});
        steps.push_back(std::move(step));
    }
    return steps;
}

bool operator_equal(const SearchResult& a, const SearchResult& b) {
    return a.matches == b.matches && a.searched == b.searched;
}

// Readers search while one thread applies and another merges. Each result must be that of
// one step, and a reader never sees an earlier step after a later one.
TEST(IndexThreads, EveryResultIsThatOfOnePublishedState) {
    std::mt19937 random(172);
    const Signature signature = random_signature(random, kShape);
    const std::vector<Step> steps = make_steps(signature, 150);
    const Query query = make_query(signature, *built_in_profile("scanned"), kM);

    Index index({.index_m = 10, .tail_capacity = 6});
    index.apply(steps[0].upserts, steps[0].removals);
    std::atomic<bool> done = false;
    std::atomic<int> reads = 0;
    std::atomic<int> strays = 0;
    std::atomic<int> merges = 0;

    const auto read = [&] {
        std::size_t at = 0;
        while (!done) {
            const SearchResult found = index.snapshot()->search(query, {kLimit});
            while (at < steps.size() && !operator_equal(steps[at].expected, found)) ++at;
            if (at == steps.size()) {
                ++strays;
                return;
            }
            ++reads;
        }
    };
    const auto merge = [&] {
        while (!done) {
            if (index.merge_once()) {
                ++merges;
            } else {
                std::this_thread::yield();
            }
        }
    };
    std::vector<std::thread> threads;
    threads.emplace_back(read);
    threads.emplace_back(read);
    threads.emplace_back(merge);

    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        index.apply(steps[i].upserts, steps[i].removals);
        // Some results of every state, unless a reader has given up.
        while (reads < int(2 * i) && strays == 0 &&
               std::chrono::steady_clock::now() < deadline) {
            std::this_thread::yield();
        }
    }
    done = true;
    for (std::thread& thread : threads) thread.join();

    EXPECT_EQ(strays, 0);
    EXPECT_GE(reads, int(2 * (steps.size() - 1)));
    EXPECT_GT(merges, 0);
    EXPECT_TRUE(
        operator_equal(index.snapshot()->search(query, {kLimit}), steps.back().expected));
}

}  // namespace
}  // namespace haarmony::image
