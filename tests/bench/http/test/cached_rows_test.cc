#include "tests/bench/http/cached_rows.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "engine/core/executor.h"
#include "engine/image/signature_codec.h"
#include "schema/image_store.h"
#include "tests/eval/signature_cache.h"
#include "tests/eval/test/generated_pictures.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::bench {
namespace {

constexpr std::int64_t kPictures = 4;

class CachedRows : public testing::Test {
  protected:
    CachedRows() {
        InlineExecutor executor;
        const auto photos =
            eval::load_small_photos(eval::generated_pictures(2), executor);
        collection_ =
            eval::make_synthetic_collection(*photos, {7, kPictures, 1}, executor);
        const auto written = eval::write_collection_cache(collection_, cache_);
        EXPECT_TRUE(written) << written.error().message;
    }

    schema::ScratchFolder folder_;
    const std::string cache_ = folder_.file("pictures.cache");
    const std::string database_ = folder_.file("rows.db");
    eval::SyntheticCollection collection_;
};

TEST_F(CachedRows, HaveTheFirstSignaturesOfTheFile) {
    const auto written = write_cached_rows(database_, kPictures - 1, cache_);
    ASSERT_TRUE(written) << written.error().message;
    auto database = schema::Database::open(database_, schema::Database::Mode::kReadOnly);
    ASSERT_TRUE(database);
    schema::ImageStore store(database.value());
    std::int64_t rows = 0;
    const auto visited =
        store.for_each_searchable([&](const schema::SearchableImage& image) {
            EXPECT_EQ(to_int(image.id), ++rows);
            const auto read = image::decode_signature(image.signature);
            ASSERT_TRUE(read) << read.error().message;
            EXPECT_EQ(eval::pack(*read),
                      collection_.signatures[static_cast<std::size_t>(rows - 1)]);
        });
    ASSERT_TRUE(visited);
    EXPECT_EQ(rows, kPictures - 1);
}

TEST_F(CachedRows, MoreThanTheFileHasAreRefusedBeforeAnythingIsWritten) {
    const auto written = write_cached_rows(database_, kPictures + 1, cache_);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(written.error().message, cache_ + ": 4 pictures, not 5");
    EXPECT_FALSE(std::filesystem::exists(database_));
}

TEST_F(CachedRows, AFileThatIsNotThereIsNamed) {
    const auto written = write_cached_rows(database_, 1, folder_.file("none"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kNotFound);
    EXPECT_NE(written.error().message.find(folder_.file("none")), std::string::npos);
}

}  // namespace
}  // namespace haarmony::bench
