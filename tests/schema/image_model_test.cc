// The store against a model of it: a std::map with the rules of image_store.h in plain code.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

struct Row {
    ImageState state;
    ImageOrigin origin;
    std::string uri;
    FileStamp stamp;
    std::vector<std::uint8_t> signature;
    std::set<std::string> tags;
    std::string failure;
    std::int64_t revision;
    std::map<std::string, std::vector<std::uint8_t>> variants = {};
};

std::map<std::string, std::vector<std::uint8_t>> by_name(
    std::span<const SignatureVariant> variants) {
    std::map<std::string, std::vector<std::uint8_t>> named;
    for (const SignatureVariant& one : variants) named[one.variant] = one.signature;
    return named;
}

// Some of three variants, of few different contents.
std::vector<SignatureVariant> some_variants(unsigned choice) {
    std::vector<SignatureVariant> variants;
    for (const unsigned bit : {1u, 2u, 4u}) {
        if ((choice & bit) == 0) continue;
        variants.push_back(
            {"v" + std::to_string(bit), some_bytes(static_cast<int>(choice % 16), 40)});
    }
    return variants;
}

using Model = std::map<std::int64_t, Row>;

Row row_of(const NewImage& image) {
    return {ImageState::kIndexed,
            image.origin,
            image.uri,
            image.stamp,
            image.signature,
            {image.tags.begin(), image.tags.end()},
            "",
            1,
            by_name(image.variants)};
}

Model::iterator file_of(Model& model, const std::string& uri) {
    return std::find_if(model.begin(), model.end(), [&](const auto& entry) {
        return entry.second.origin == ImageOrigin::kFile && entry.second.uri == uri;
    });
}

class Machine {
  public:
    Machine(ImageStore& store, unsigned seed) : store_(store), random_(seed) {}

    void step() {
        const int number = static_cast<int>(random_() % 40);
        const std::int64_t id = static_cast<std::int64_t>(random_() % (next_ + 2));
        NewImage image =
            random_() % 2 == 0 ? file_picture(number) : upload_picture(number);
        image.variants = some_variants(static_cast<unsigned>(random_() % 32));
        switch (random_() % 8) {
            case 0:
                add(image);
                break;
            case 1:
                update(id, image);
                break;
            case 2:
                touch(id, image.stamp);
                break;
            case 3:
                mark_failed(image.uri, image.stamp);
                break;
            case 4:
                remove(id);
                break;
            case 5:
                set_variant(id, {"v1", some_bytes(number % 4, 40)});
                break;
            case 6:
                describe(id, image);
                break;
            default:
                EXPECT_EQ(store_.purge(ImageId{id}).has_value(), model_.erase(id) == 1);
        }
    }

    void compare() {
        std::vector<ImageId> everything;
        Counts counts;
        std::map<ImageId, std::vector<std::uint8_t>> searchable;
        std::vector<std::string> files;
        for (std::int64_t id = 0; id <= next_; ++id) everything.push_back(ImageId{id});
        for (const auto& [id, row] : model_) {
            if (row.state == ImageState::kIndexed) {
                ++counts.indexed;
                searchable[ImageId{id}] = row.signature;
            } else {
                ++(row.state == ImageState::kFailed ? counts.failed : counts.deleted);
            }
            if (row.origin == ImageOrigin::kFile) files.push_back(row.uri);
            compare_row(id, row);
        }
        std::sort(files.begin(), files.end());

        const Counts stored = expect(store_.counts());
        EXPECT_EQ(stored.indexed, counts.indexed);
        EXPECT_EQ(stored.failed, counts.failed);
        EXPECT_EQ(stored.deleted, counts.deleted);

        std::map<ImageId, std::vector<std::uint8_t>> scanned;
        expect(store_.for_each_searchable([&](const SearchableImage& image) {
            scanned[image.id].assign(image.signature.begin(), image.signature.end());
        }));
        EXPECT_EQ(scanned, searchable);

        std::vector<std::string> walked;
        expect(store_.for_each_file(
            "file:///photos/",
            [&](const KnownFile&, const std::string& uri) { walked.push_back(uri); }));
        std::erase_if(files, [](const std::string& uri) {
            return !uri.starts_with("file:///photos/");
        });
        EXPECT_EQ(walked, files);

        const auto all = expect(store_.list({.limit = 1000, .after = {}, .tags = {}}));
        const auto many = expect(store_.get_many(everything));
        ASSERT_EQ(all.size(), searchable.size());
        ASSERT_EQ(many.size(), searchable.size());
        auto want = searchable.begin();
        for (std::size_t i = 0; i < all.size(); ++i, ++want) {
            EXPECT_EQ(all[i].id, want->first);
            EXPECT_EQ(many[i].id, want->first);
            const Row& row = model_.at(to_int(want->first));
            EXPECT_EQ(std::set(all[i].tags.begin(), all[i].tags.end()), row.tags);
            EXPECT_EQ(many[i].tags, all[i].tags);
        }
        compare_tag("tag1");
        compare_variants();
    }

  private:
    void add(const NewImage& image) {
        const bool taken = image.origin == ImageOrigin::kFile &&
                           file_of(model_, image.uri) != model_.end();
        const auto id = store_.add(image);
        ASSERT_EQ(id.has_value(), !taken);
        if (taken) return;
        EXPECT_GT(to_int(*id), next_);
        next_ = to_int(*id);
        model_[next_] = row_of(image);
    }

    void update(std::int64_t id, const NewImage& image) {
        const auto row = model_.find(id);
        ASSERT_EQ(store_.update(ImageId{id}, image).has_value(), row != model_.end());
        if (row == model_.end()) return;
        row->second.state = ImageState::kIndexed;
        row->second.stamp = image.stamp;
        row->second.signature = image.signature;
        row->second.variants = by_name(image.variants);
        row->second.failure.clear();
        ++row->second.revision;
    }

    void set_variant(std::int64_t id, const SignatureVariant& variant) {
        const auto row = model_.find(id);
        const bool there =
            row != model_.end() && row->second.state == ImageState::kIndexed;
        ASSERT_EQ(store_.set_variant(ImageId{id}, variant).has_value(), there);
        if (there) row->second.variants[variant.variant] = variant.signature;
    }

    void describe(std::int64_t id, const NewImage& image) {
        const auto row = model_.find(id);
        const bool there =
            row != model_.end() && row->second.state != ImageState::kDeleted;
        ImageDescription description;
        description.tags = image.tags;
        // A file's uri stays: asking for another one changes nothing at all.
        if (random_() % 2 == 0) description.uri = image.uri;
        const bool allowed =
            there && !(description.uri && row->second.origin == ImageOrigin::kFile);
        ASSERT_EQ(store_.describe(ImageId{id}, description).has_value(), allowed);
        if (!allowed) return;
        row->second.tags = {image.tags.begin(), image.tags.end()};
        if (description.uri) row->second.uri = *description.uri;
        ++row->second.revision;
    }

    void touch(std::int64_t id, const FileStamp& stamp) {
        const auto row = model_.find(id);
        ASSERT_EQ(store_.touch(ImageId{id}, stamp).has_value(), row != model_.end());
        if (row == model_.end()) return;
        row->second.stamp = stamp;
        ++row->second.revision;
    }

    void mark_failed(const std::string& uri, const FileStamp& stamp) {
        const ImageId id = expect(store_.mark_failed(uri, stamp, "broken"));
        if (const auto row = file_of(model_, uri); row != model_.end()) {
            EXPECT_EQ(to_int(id), row->first);
            row->second.state = ImageState::kFailed;
            row->second.stamp = stamp;
            row->second.signature.clear();
            row->second.variants.clear();
            row->second.failure = "broken";
            ++row->second.revision;
            return;
        }
        EXPECT_GT(to_int(id), next_);
        next_ = to_int(id);
        model_[next_] = {
            ImageState::kFailed, ImageOrigin::kFile, uri, stamp, {}, {}, "broken", 1};
    }

    void remove(std::int64_t id) {
        const auto row = model_.find(id);
        const bool there =
            row != model_.end() && row->second.state != ImageState::kDeleted;
        ASSERT_EQ(store_.remove(ImageId{id}).has_value(), there);
        if (!there) return;
        if (row->second.origin == ImageOrigin::kUpload) {
            model_.erase(row);
            return;
        }
        row->second.state = ImageState::kDeleted;
        row->second.signature.clear();
        row->second.variants.clear();
        row->second.failure.clear();
        ++row->second.revision;
    }

    void compare_row(std::int64_t id, const Row& row) {
        const auto image = store_.get(ImageId{id});
        ASSERT_EQ(image.has_value(), row.state != ImageState::kDeleted) << id;
        EXPECT_EQ(store_.signature(ImageId{id}).has_value(),
                  row.state == ImageState::kIndexed);
        EXPECT_EQ(store_.thumbnail(ImageId{id}).has_value(),
                  row.state == ImageState::kIndexed);
        if (row.origin == ImageOrigin::kFile) {
            const auto known = expect(store_.known_file(row.uri));
            ASSERT_TRUE(known.has_value());
            EXPECT_EQ(to_int(known->id), id);
            EXPECT_EQ(known->state, row.state);
            EXPECT_EQ(known->stamp.content_hash, row.stamp.content_hash);
        }
        if (!image) return;
        EXPECT_EQ(image->state, row.state);
        EXPECT_EQ(image->origin, row.origin);
        EXPECT_EQ(image->uri, row.uri);
        EXPECT_EQ(image->stamp.mtime_ns, row.stamp.mtime_ns);
        EXPECT_EQ(image->failure, row.failure);
        EXPECT_EQ(image->revision, row.revision);
    }

    void compare_tag(const std::string& tag) {
        std::vector<std::int64_t> want;
        for (const auto& [id, row] : model_) {
            if (row.state == ImageState::kIndexed && row.tags.contains(tag)) {
                want.push_back(id);
            }
        }
        std::vector<std::int64_t> found;
        for (const Image& image :
             expect(store_.list({.limit = 1000, .after = {}, .tags = {tag, "all"}}))) {
            found.push_back(to_int(image.id));
        }
        EXPECT_EQ(found, want);
    }

    void compare_variants() {
        std::map<std::string, std::int64_t> counts;
        std::vector<ImageId> without;
        for (const auto& [id, row] : model_) {
            for (const auto& [name, signature] : row.variants) ++counts[name];
            if (row.state == ImageState::kIndexed && !row.variants.contains("v2")) {
                without.push_back(ImageId{id});
            }
        }
        const auto counted = expect(store_.variant_counts());
        EXPECT_EQ(std::map(counted.begin(), counted.end()), counts);
        EXPECT_EQ(expect(store_.without_variant("v2", std::nullopt, 1000)), without);
    }

    ImageStore& store_;
    std::mt19937 random_;
    Model model_;
    std::int64_t next_ = 0;  // the largest id so far
};

TEST(ImageModel, RandomOperationsGiveWhatTheRulesSay) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(seed);
        const ScratchFolder folder;
        Database database = open_database(folder.file("x.db"));
        run_sql(database.handle(), "PRAGMA synchronous = OFF");  // nothing crashes here
        ImageStore store(database);
        Machine machine(store, seed);
        for (int round = 0; round < 10; ++round) {
            for (int step = 0; step < 30; ++step) machine.step();
            machine.compare();
            if (testing::Test::HasFailure()) return;
        }
        EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
    }
}

}  // namespace
}  // namespace haarmony::schema
