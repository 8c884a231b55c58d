#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

SignatureVariant variant_of(const std::string& name, int number) {
    return {name, some_bytes(number, 300)};
}

class ImageVariants : public testing::Test {
  protected:
    [[nodiscard]] ImageId add(int number, std::vector<SignatureVariant> variants) {
        NewImage image = file_picture(number);
        image.variants = std::move(variants);
        return expect(store_.add(image));
    }
    [[nodiscard]] std::int64_t last() {
        return sql_integer(database_.handle(),
                           "SELECT coalesce(max(seq), 0) FROM changes");
    }
    [[nodiscard]] std::vector<Change> after(std::int64_t sequence) {
        return expect(store_.changes_after(sequence, 100));
    }
    [[nodiscard]] std::vector<SignatureVariant> scanned(ImageId id) {
        std::vector<SignatureVariant> found;
        expect(store_.for_each_searchable([&](const SearchableImage& image) {
            if (image.id == id)
                found.assign(image.variants.begin(), image.variants.end());
        }));
        return found;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
};

TEST_F(ImageVariants, ComeBackWithTheirPictureByScanByChangeAndAlone) {
    const ImageId plain = add(1, {});
    const auto lab = variant_of("lab-standard", 1);
    const auto cropped = variant_of("yiq-cropped", 2);
    const ImageId rich = add(2, {cropped, lab});
    const ImageId other = add(3, {variant_of("lab-standard", 3)});

    std::vector<ImageId> order;
    expect(store_.for_each_searchable([&](const SearchableImage& image) {
        order.push_back(image.id);
        const NewImage want = file_picture(static_cast<int>(order.size()));
        EXPECT_EQ(image.width, want.width);
        EXPECT_EQ(image.height, want.height);
        EXPECT_EQ(std::vector(image.signature.begin(), image.signature.end()),
                  want.signature);
    }));
    EXPECT_THAT(order, ElementsAre(plain, rich, other));
    EXPECT_THAT(scanned(plain), IsEmpty());
    EXPECT_THAT(scanned(rich), ElementsAre(lab, cropped));
    EXPECT_THAT(scanned(other), ElementsAre(variant_of("lab-standard", 3)));

    const auto changes = after(0);
    ASSERT_EQ(changes.size(), 3u);
    EXPECT_THAT(changes[0].variants, IsEmpty());
    EXPECT_THAT(changes[1].variants, ElementsAre(lab, cropped));
    EXPECT_EQ(changes[1].width, file_picture(2).width);
    EXPECT_EQ(changes[1].height, file_picture(2).height);
    EXPECT_EQ(changes[1].signature, file_picture(2).signature);
    EXPECT_THAT(changes[2].variants, ElementsAre(variant_of("lab-standard", 3)));

    EXPECT_EQ(expect(store_.signature(rich, "lab-standard")), lab.signature);
    for (const auto& [id, name] :
         {std::pair(plain, "lab-standard"), std::pair(rich, "rgb")}) {
        const auto missing = store_.signature(id, name);
        ASSERT_FALSE(missing);
        EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
        EXPECT_EQ(missing.error().message,
                  "no signature \"" + std::string(name) + "\" of image " +
                      std::to_string(to_int(id)));
    }
}

TEST_F(ImageVariants, AVariantThatIsNewOrAnotherOrGoneMovesItsPicture) {
    const ImageId a = add(1, {variant_of("lab", 1)});
    const ImageId b = add(2, {});
    auto before = last();
    expect(store_.set_variant(a, variant_of("rgb", 5)));
    ASSERT_EQ(after(before).size(), 1u);
    EXPECT_THAT(after(before)[0].variants,
                ElementsAre(variant_of("lab", 1), variant_of("rgb", 5)));

    before = last();
    expect(store_.set_variant(a, variant_of("rgb", 5)));  // the same bytes
    EXPECT_THAT(after(before), IsEmpty());
    expect(store_.set_variant(a, variant_of("rgb", 6)));
    ASSERT_EQ(after(before).size(), 1u);
    EXPECT_EQ(expect(store_.signature(a, "rgb")), some_bytes(6, 300));

    before = last();
    const RawConnection other(folder_.file("x.db"));
    run_sql(other.handle(), "DELETE FROM image_signatures WHERE variant = 'lab'");
    run_sql(other.handle(), "INSERT INTO image_signatures VALUES (2, 'raw', x'01')");
    const auto changes = after(before);
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].id, a);
    EXPECT_THAT(changes[0].variants, ElementsAre(variant_of("rgb", 6)));
    EXPECT_EQ(changes[1].id, b);
    EXPECT_EQ(changes[1].variants.front().variant, "raw");
}

TEST_F(ImageVariants, UpdateLeavesExactlyThoseOfTheNewPixels) {
    const ImageId id = add(1, {variant_of("a", 1), variant_of("b", 2)});
    NewImage same = file_picture(1);
    same.variants = {variant_of("b", 2), variant_of("a", 1)};
    const auto before = last();
    expect(store_.update(id, same));
    EXPECT_THAT(after(before), IsEmpty());

    NewImage now = file_picture(7);
    now.variants = {variant_of("c", 9), variant_of("b", 3), variant_of("b", 4)};
    expect(store_.update(id, now));
    EXPECT_THAT(scanned(id), ElementsAre(variant_of("b", 4), variant_of("c", 9)));
    EXPECT_THAT(after(before).front().variants, scanned(id));
    now.variants.clear();
    expect(store_.update(id, now));
    EXPECT_THAT(scanned(id), IsEmpty());
}

TEST_F(ImageVariants, GoWhenTheirPictureIsNotSearchableAnyMore) {
    const auto variants = std::vector{variant_of("lab", 1), variant_of("rgb", 2)};
    const ImageId failed = add(1, variants);
    const ImageId deleted = add(2, variants);
    const ImageId purged = add(3, variants);
    const auto before = last();
    expect(store_.mark_failed(file_picture(1).uri, {}, "cut"));
    expect(store_.remove(deleted));
    expect(store_.purge(purged));
    EXPECT_EQ(sql_integer(database_.handle(), "SELECT count(*) FROM image_signatures"),
              0);
    const auto changes = after(before);
    ASSERT_EQ(changes.size(), 3u);
    for (const Change& change : changes) {
        EXPECT_THAT(change.signature, IsEmpty());
        EXPECT_THAT(change.variants, IsEmpty());
        EXPECT_EQ(change.width, 0);
        EXPECT_EQ(change.height, 0);
    }
    for (const ImageId id : {failed, deleted, purged, ImageId{99}}) {
        const auto refused = store_.set_variant(id, variant_of("lab", 1));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
        EXPECT_EQ(refused.error().message, "no image " + std::to_string(to_int(id)));
    }
}

TEST_F(ImageVariants, NoWriterCanLeaveOneWithoutASearchablePicture) {
    const ImageId searchable = add(1, {variant_of("lab", 1)});
    static_cast<void>(searchable);
    static_cast<void>(expect(store_.mark_failed("file:///f", {}, "cut")));
    const RawConnection other(folder_.file("x.db"));
    for (const std::string sql :
         {"INSERT INTO image_signatures VALUES (2, 'lab', x'01')",
          "INSERT INTO image_signatures VALUES (77, 'lab', x'01')"}) {
        EXPECT_THROW(run_sql(other.handle(), sql), std::runtime_error) << sql;
    }
    for (const std::string sql : {"UPDATE image_signatures SET image_id = 2",
                                  "UPDATE image_signatures SET variant = 'other'"}) {
        EXPECT_THROW(run_sql(other.handle(), sql), std::runtime_error) << sql;
    }
    EXPECT_EQ(sql_integer(database_.handle(), "SELECT count(*) FROM image_signatures"),
              1);
}

TEST_F(ImageVariants, BadValuesAreRefusedByNameAndLeaveNothing) {
    const ImageId id = add(1, {variant_of("kept", 1)});
    const auto before = last();
    const std::pair<SignatureVariant, std::string> bad[] = {
        {{"", {1}}, "variant_has_a_name"},
        {{std::string(65, 'x'), {1}}, "variant_has_a_name"},
        {{"empty", {}}, "variant_is_not_empty"}};
    for (const auto& [variant, constraint] : bad) {
        NewImage image = file_picture(2);
        image.variants = {variant_of("good", 2), variant};
        for (const Result<void>& refused :
             {store_.set_variant(id, variant), store_.update(id, image)}) {
            ASSERT_FALSE(refused);
            EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
            EXPECT_NE(refused.error().message.find(constraint), std::string::npos)
                << refused.error().message;
        }
        EXPECT_EQ(store_.add(image).error().code, ErrorCode::kInvalidArgument);
    }
    EXPECT_EQ(last(), before);
    EXPECT_THAT(scanned(id), ElementsAre(variant_of("kept", 1)));
    EXPECT_EQ(expect(store_.counts()).indexed, 1);
    // 64 characters, not bytes.
    std::string longest;
    for (int i = 0; i < 64; ++i) longest += "\xc3\xa9";
    EXPECT_TRUE(store_.set_variant(id, variant_of(longest, 1)));
}

TEST_F(ImageVariants, ThoseWithoutOneAreListedInSteps) {
    const ImageId a = add(1, {variant_of("lab", 1)});
    const ImageId b = add(2, {});
    const ImageId c = add(3, {variant_of("rgb", 1)});
    const ImageId gone = add(4, {});
    expect(store_.remove(gone));
    const ImageId d = add(5, {});
    EXPECT_THAT(expect(store_.without_variant("lab", std::nullopt, 10)),
                ElementsAre(b, c, d));
    EXPECT_THAT(expect(store_.without_variant("lab", std::nullopt, 2)),
                ElementsAre(b, c));
    EXPECT_THAT(expect(store_.without_variant("lab", c, 2)), ElementsAre(d));
    EXPECT_THAT(expect(store_.without_variant("other", std::nullopt, 10)),
                ElementsAre(a, b, c, d));
    EXPECT_THAT(expect(store_.variant_counts()),
                ElementsAre(Pair("lab", 1), Pair("rgb", 1)));
    expect(store_.set_variant(b, variant_of("lab", 2)));
    EXPECT_THAT(expect(store_.variant_counts()),
                ElementsAre(Pair("lab", 2), Pair("rgb", 1)));
    EXPECT_THAT(expect(store_.without_variant("lab", std::nullopt, 10)),
                ElementsAre(c, d));
}

TEST_F(ImageVariants, TheScanIsTheSameFewStatementsForAnyNumberOfPictures) {
    expect(store_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 50; ++i) {
            static_cast<void>(add(i, {variant_of("lab", i), variant_of("rgb", i)}));
        }
        return {};
    }));
    int statements = 0;
    sqlite3_trace_v2(
        database_.handle(),
        SQLITE_TRACE_STMT,
        [](unsigned, void* count, void*, void*) {
            ++*static_cast<int*>(count);
            return 0;
        },
        &statements);
    std::size_t variants = 0;
    expect(store_.for_each_searchable(
        [&](const SearchableImage& image) { variants += image.variants.size(); }));
    EXPECT_EQ(variants, 100u);
    EXPECT_EQ(statements, 5);  // begin, sequence, two scans, end
}

TEST_F(ImageVariants, TheScanBelongsToExactlyItsSequenceNumber) {
    const ImageId first = add(1, {variant_of("lab", 1)});
    const ImageId second = add(2, {variant_of("lab", 2)});
    Database other = open_database(folder_.file("x.db"));
    ImageStore writer(other);
    bool wrote = false;
    std::vector<SignatureVariant> seen;
    const auto sequence =
        expect(store_.for_each_searchable([&](const SearchableImage& image) {
            if (!wrote) {
                wrote = true;
                expect(writer.set_variant(second, variant_of("lab", 3)));
                expect(writer.set_variant(first, variant_of("new", 4)));
            }
            seen.insert(seen.end(), image.variants.begin(), image.variants.end());
        }));
    EXPECT_THAT(seen, ElementsAre(variant_of("lab", 1), variant_of("lab", 2)));
    const auto changes = after(sequence);
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_THAT(changes[0].variants, ElementsAre(variant_of("lab", 3)));
    EXPECT_EQ(changes[1].variants.size(), 2u);
}

}  // namespace
}  // namespace haarmony::schema
