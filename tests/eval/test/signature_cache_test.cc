#include "tests/eval/signature_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "engine/core/executor.h"
#include "tests/eval/test/generated_pictures.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

constexpr std::size_t kHeader = 64;
constexpr std::size_t kSum = 8;
constexpr int kQueries = 2;
constexpr std::int64_t kImages = 5;

SyntheticCollection small_collection() {
    InlineExecutor executor;
    const SmallPhotos photos = *load_small_photos(generated_pictures(4), executor);
    return make_synthetic_collection(photos, {7, kImages, kQueries}, executor);
}

class SignatureCache : public ::testing::Test {
  protected:
    void write(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::string bytes() const {
        std::ifstream in(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    // What reading says of the file with one byte turned over.
    [[nodiscard]] Error error_with_flipped(std::size_t at) const {
        std::string damaged = bytes();
        damaged.at(at) = static_cast<char>(~damaged[at]);
        write(damaged);
        const auto read = read_collection_cache(path_, kImages);
        return read ? Error{} : read.error();
    }

    haarmony::testing::TemporaryFolder folder_;
    std::string path_ = folder_.file("cache");
    static const SyntheticCollection& collection() {
        static const SyntheticCollection made = small_collection();
        return made;
    }
    void SetUp() override { ASSERT_TRUE(write_collection_cache(collection(), path_)); }
};

TEST_F(SignatureCache, GivesBackWhatWasWritten) {
    const auto read = read_collection_cache(path_, kImages);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->seed, collection().seed);
    EXPECT_EQ(read->source_digest, collection().source_digest);
    EXPECT_EQ(read->signatures, collection().signatures);
    EXPECT_EQ(read->cells, collection().cells);
    EXPECT_EQ(read->histograms, collection().histograms);
    EXPECT_EQ(read->queries, collection().queries);
}

TEST_F(SignatureCache, GivesThePrefixThatIsAskedFor) {
    const auto read = read_collection_cache(path_, 3);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->size(), 3);
    EXPECT_EQ(read->cells.size(), 3U);
    EXPECT_EQ(read->histograms.size(), 3U);
    EXPECT_EQ(read->signatures[2], collection().signatures[2]);
}

TEST_F(SignatureCache, GivesSignaturesAloneWithoutTheRest) {
    const auto read = read_signature_cache(path_);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->signatures, collection().signatures);
    EXPECT_EQ(read->queries, collection().queries);
    EXPECT_TRUE(read->cells.empty());
    EXPECT_TRUE(read->histograms.empty());
}

TEST_F(SignatureCache, HoldsMoreThanOneBlock) {
    SyntheticCollection large = collection();
    const auto count = static_cast<std::size_t>(kCacheBlock) + 3;
    for (std::size_t i = large.signatures.size(); i < count; ++i) {
        large.signatures.push_back(large.signatures[i % kImages]);
        large.signatures.back().average[0] = static_cast<std::int32_t>(i);
    }
    large.cells.resize(count);
    large.histograms.resize(count);
    ASSERT_TRUE(write_collection_cache(large, path_));
    const auto all = read_collection_cache(path_, large.size());
    ASSERT_TRUE(all);
    EXPECT_EQ(all->signatures, large.signatures);
    const auto alone = read_signature_cache(path_);
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->signatures, large.signatures);
}

TEST_F(SignatureCache, MissingFileIsNotFound) {
    const auto read = read_collection_cache(folder_.file("none"), 1);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kNotFound);
    EXPECT_EQ(read.error().message, folder_.file("none") + ": cannot be opened");
}

TEST_F(SignatureCache, SomethingElseIsRefused) {
    for (const std::string content : {"",
                                      "short",
                                      "a picture, say, and a long one at that "
                                      "so that it is no shorter than a header"}) {
        write(content);
        const auto read = read_collection_cache(path_, 1);
        ASSERT_FALSE(read) << content;
        EXPECT_EQ(read.error().code, ErrorCode::kUnsupportedFormat) << content;
    }
}

TEST_F(SignatureCache, AnotherVersionIsRefused) {
    for (const std::size_t at : {8U, 12U}) {
        ASSERT_TRUE(write_collection_cache(collection(), path_));
        const Error error = error_with_flipped(at);
        EXPECT_EQ(error.code, ErrorCode::kUnsupportedFormat) << at;
        EXPECT_NE(error.message.find("version "), std::string::npos) << error.message;
    }
}

TEST_F(SignatureCache, AByteTurnedOverAnywhereIsNoticed) {
    const std::size_t queries = kHeader + kSum;
    const std::size_t signatures =
        queries + kSyntheticKinds.size() * kQueries * sizeof(SyntheticQuery) + kSum;
    const std::size_t features = signatures + kImages * sizeof(PackedSignature) + kSum;
    const std::size_t end =
        features + kImages * (sizeof(CellBytes) + sizeof(HistogramCounts)) + kSum;
    ASSERT_EQ(bytes().size(), end);
    const auto message = [&](std::size_t at) {
        EXPECT_TRUE(write_collection_cache(collection(), path_));
        const Error error = error_with_flipped(at);
        EXPECT_EQ(error.code, ErrorCode::kUndecodable) << at;
        return error.message.substr(path_.size() + 2);
    };
    EXPECT_EQ(message(20), "its header is damaged");
    EXPECT_EQ(message(kHeader), "its header is damaged");
    EXPECT_EQ(message(queries), "its queries are damaged");
    EXPECT_EQ(message(signatures - 1), "its queries are damaged");
    EXPECT_EQ(message(signatures), "signatures are damaged");
    EXPECT_EQ(message(features - 1), "signatures are damaged");
    EXPECT_EQ(message(features), "descriptions are damaged");
    EXPECT_EQ(message(end - 1), "descriptions are damaged");
}

TEST_F(SignatureCache, AFileCutOffAnywhereIsNoticed) {
    const std::string whole = bytes();
    for (std::size_t length = 0; length < whole.size(); length += 37) {
        write(whole.substr(0, length));
        EXPECT_FALSE(read_collection_cache(path_, kImages)) << length;
    }
}

TEST_F(SignatureCache, TooFewPicturesAreRefused) {
    const auto read = read_collection_cache(path_, kImages + 1);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(read.error().message, path_ + ": 5 pictures, not 6");
}

TEST_F(SignatureCache, AFolderThatIsNotThereCannotBeWrittenInto) {
    const std::string path = folder_.file("none/cache");
    const auto written = write_collection_cache(collection(), path);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kIo);
    EXPECT_EQ(written.error().message, path + ": cannot be written");
}

TEST_F(SignatureCache, LeavesNothingUnfinishedBehind) {
    const std::string taken = folder_.file("taken");
    std::filesystem::create_directories(taken + "/full");
    EXPECT_FALSE(write_collection_cache(collection(), taken));
    EXPECT_FALSE(std::filesystem::exists(taken + ".part"));
}

}  // namespace
}  // namespace haarmony::eval
