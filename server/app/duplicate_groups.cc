#include "server/app/duplicate_groups.h"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

namespace haarmony::server {
namespace {

using IdPair = std::pair<ImageId, ImageId>;
using IdPairs = std::vector<IdPair>;

void add_exact(ImageId one, ImageId other, std::vector<image::DuplicatePair>& pairs) {
    pairs.push_back(
        {std::min(one, other), std::max(one, other), image::DuplicateLevel::kExact, 1.0});
}

// Pairs enough to hold the group together: a chain, and all pairs of those pictures of which
// one pair is ignored, so that a large group is no square of pairs.
void add_group(const std::vector<ImageId>& ids,
               const std::set<ImageId>& disputed,
               std::vector<image::DuplicatePair>& pairs) {
    std::optional<ImageId> last;
    for (const ImageId id : ids) {
        if (disputed.contains(id)) {
            for (const ImageId other : ids)
                if (other != id) add_exact(id, other, pairs);
            continue;
        }
        if (last) add_exact(*last, id, pairs);
        last = id;
    }
}

Result<std::vector<image::DuplicatePair>> all_pairs(schema::DuplicateStore& store,
                                                    const IdPairs& ignored,
                                                    double min_similarity) {
    const auto found = store.pairs(min_similarity);
    if (!found) return found.error();
    std::vector<image::DuplicatePair> pairs;
    for (const schema::DuplicatePair& pair : found.value())
        if (const auto level = image::duplicate_level_from_name(pair.level))
            pairs.push_back({pair.a, pair.b, *level, pair.similarity});
    const auto same = store.same_content();
    if (!same) return same.error();
    std::set<ImageId> disputed;
    for (const auto& [one, other] : ignored) disputed.insert({one, other});
    for (const std::vector<ImageId>& ids : same.value()) add_group(ids, disputed, pairs);
    return pairs;
}

}  // namespace

Result<std::unique_ptr<DuplicateGroups>> DuplicateGroups::open(
    const std::string& database_path) {
    auto writer =
        Connection::open(database_path, schema::Database::Mode::kReadWriteCreate);
    if (!writer) return std::move(writer).error();
    return std::unique_ptr<DuplicateGroups>(
        new DuplicateGroups(database_path, std::move(writer).value()));
}

DuplicateGroups::DuplicateGroups(const std::string& database_path,
                                 std::unique_ptr<Connection> writer)
    : writer_(std::move(writer)), readers_([path = database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }) {}

Result<DuplicatePage> DuplicateGroups::list(const DuplicateQuery& query) {
    auto connection = readers_.lend();
    if (!connection) return connection.error();
    schema::DuplicateStore& store = (*connection)->duplicates();
    const Result<IdPairs> ignored = store.ignored();
    if (!ignored) return ignored.error();
    const auto pairs = all_pairs(store, ignored.value(), query.least.min_similarity);
    if (!pairs) return pairs.error();

    DuplicatePage page;
    for (image::DuplicateGroup& group :
         image::group_duplicates(pairs.value(), ignored.value(), query.least)) {
        if (query.after && group.ids.front() <= *query.after) continue;
        page.more = static_cast<int>(page.groups.size()) == query.limit;
        if (page.more) break;
        const std::span<const ImageId> ids(group.ids);
        auto images =
            (*connection)->images().get_many(ids.first(std::min(ids.size(), kMaxImages)));
        if (!images) return images.error();
        page.groups.push_back({std::move(group), std::move(images).value()});
    }
    return page;
}

Result<void> DuplicateGroups::ignore(ImageId one, ImageId other) {
    const std::lock_guard lock(writer_mutex_);
    return writer_->duplicates().ignore(one, other);
}

}  // namespace haarmony::server
