// Ranges of ids in which several connections read the searchable pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

class SearchableRanges : public testing::Test {
  protected:
    // Ids 1..count, of which every seventh is gone.
    void fill(int count) {
        expect(store_.transaction([&]() -> Result<void> {
            for (int i = 1; i <= count; ++i) {
                const ImageId id = expect(store_.add(file_picture(i)));
                if (i % 7 == 0) {
                    expect(store_.remove(id));
                } else {
                    searchable_.push_back(id);
                }
            }
            return {};
        }));
    }
    static std::vector<ImageId> ids_in(ImageStore& store, const IdRange& range) {
        std::vector<ImageId> ids;
        expect(store.for_each_searchable(range, [&](const SearchableImage& image) {
            ids.push_back(image.id);
            return true;
        }));
        return ids;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
    std::vector<ImageId> searchable_;
};

TEST_F(SearchableRanges, HoldEveryPictureOnceAndAreFull) {
    fill(50);
    for (const int size : {1, 2, 7, 21, 22, 42, 43, 44, 1000}) {
        const auto ranges = expect(store_.searchable_ranges(size));
        std::vector<ImageId> all;
        for (const IdRange& range : ranges) {
            const std::vector<ImageId> ids = ids_in(store_, range);
            if (&range != &ranges.back()) {
                EXPECT_EQ(int(ids.size()), size);
            }
            all.insert(all.end(), ids.begin(), ids.end());
        }
        EXPECT_EQ(all, searchable_) << size;
        EXPECT_EQ(ranges.size(), (searchable_.size() + size - 1) / size) << size;
    }
}

TEST_F(SearchableRanges, FollowOneAnotherAndHaveRoomForEveryId) {
    fill(20);
    const auto ranges = expect(store_.searchable_ranges(3));
    EXPECT_EQ(to_int(ranges.front().first), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(to_int(ranges.back().last), std::numeric_limits<std::int64_t>::max());
    for (std::size_t i = 1; i < ranges.size(); ++i)
        EXPECT_EQ(to_int(ranges[i].first), to_int(ranges[i - 1].last) + 1);
}

TEST_F(SearchableRanges, OfAnEmptyDatabaseAreOneWithNothing) {
    const auto ranges = expect(store_.searchable_ranges(5));
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_TRUE(ids_in(store_, ranges[0]).empty());
}

TEST_F(SearchableRanges, GiveTheVariantsOfTheirPictures) {
    fill(6);
    for (const ImageId id : searchable_)
        expect(store_.set_variant(id, {"lab", {std::uint8_t(to_int(id))}}));
    std::vector<std::uint8_t> variants;
    expect(store_.for_each_searchable(
        {ImageId{3}, ImageId{5}}, [&](const SearchableImage& image) {
            for (const SignatureVariant& of : image.variants)
                variants.push_back(of.signature[0]);
            return true;
        }));
    EXPECT_EQ(variants, (std::vector<std::uint8_t>{3, 4, 5}));
}

TEST_F(SearchableRanges, AVisitThatHasEnoughEndsTheScan) {
    fill(6);
    int visits = 0;
    const auto sequence = store_.for_each_searchable(
        {ImageId{1}, ImageId{6}}, [&](const SearchableImage&) { return ++visits < 2; });
    EXPECT_TRUE(sequence);
    EXPECT_EQ(visits, 2);
}

TEST_F(SearchableRanges, LastSequenceIsThatOfTheLastChange) {
    EXPECT_EQ(expect(store_.last_sequence()), 0);
    fill(6);
    const auto changes = expect(store_.changes_after(0, 100));
    EXPECT_EQ(expect(store_.last_sequence()), changes.back().sequence);
}

}  // namespace
}  // namespace haarmony::schema
