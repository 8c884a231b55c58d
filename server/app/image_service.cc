#include "server/app/image_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "engine/image/aspect.h"
#include "engine/image/signature_codec.h"
#include "ingest/stored_profile.h"
#include "ingest/variant.h"
#include "server/app/log_value.h"
#include "server/app/logged.h"

namespace haarmony::server {
namespace {

Error built_in(std::string_view name) {
    return {ErrorCode::kConflict,
            "the profile '" + std::string(name) + "' is built in: it cannot be changed",
            "name"};
}

SnapshotKeeperOptions keeping(const ImageServiceOptions& options) {
    SnapshotKeeperOptions keeping;
    keeping.database_path = options.database_path;
    keeping.threads = options.search_cores;
    return keeping;
}

}  // namespace

Result<std::unique_ptr<ImageService>> ImageService::open(
    const ImageServiceOptions& options) {
    // The writer comes first: it creates and migrates what the readers expect.
    auto writer =
        Connection::open(options.database_path, schema::Database::Mode::kReadWriteCreate);
    if (!writer) return std::move(writer).error();
    FollowerOptions follow;
    follow.database_path = options.database_path;
    follow.index.index_m = options.index_m;
    follow.poll_interval = options.poll_interval;
    follow.snapshot_path = snapshot_path_of(options.database_path);
    follow.threads = options.search_cores;
    auto follower = IndexFollower::start(follow);
    if (!follower) return std::move(follower).error();
    return std::unique_ptr<ImageService>(new ImageService(
        options, std::move(writer).value(), std::move(follower).value()));
}

ImageService::ImageService(const ImageServiceOptions& options,
                           std::unique_ptr<Connection> writer,
                           std::unique_ptr<IndexFollower> follower)
    : writer_(std::move(writer)),
      readers_([path = options.database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }),
      follower_(std::move(follower)),
      snapshots_(keeping(options), *follower_),
      pictures_(options.decode),
      cores_(options.search_cores) {}

template <typename Work>
auto ImageService::write(Work&& work) {
    auto written = [&] {
        const std::lock_guard lock(writer_mutex_);
        return work(writer_->images());
    }();
    if (!written) return logged(std::move(written));
    // The write stands whatever happens here; the follower tries again by itself.
    if (const Result<void> seen = follower_->catch_up(); !seen)
        spdlog::error("event=catch_up_failed reason={}", log_value(seen.error().message));
    return written;
}

template <typename Work>
auto ImageService::read(Work&& work) {
    using Answer = decltype(work(std::declval<schema::ImageStore&>()));
    auto connection = readers_.lend();
    if (!connection) return logged(Answer(connection.error()));
    return logged(work((*connection)->images()));
}

template <typename Work>
auto ImageService::record(Work&& work) {
    const std::lock_guard lock(writer_mutex_);
    return logged(work(*writer_));
}

template <typename Work>
auto ImageService::consult(Work&& work) {
    using Answer = decltype(work(std::declval<Connection&>()));
    auto connection = readers_.lend();
    if (!connection) return logged(Answer(connection.error()));
    return logged(work(**connection));
}

Result<ServiceStatus> ImageService::status() {
    const Result<schema::Counts> rows =
        read([](schema::ImageStore& images) { return images.counts(); });
    if (!rows) return rows.error();
    ServiceStatus status;
    status.rows = rows.value();
    const Snapshots snapshots = follower_->snapshots();
    status.index = total_stats(snapshots);
    for (const auto& [variant, snapshot] : snapshots)
        status.variants.emplace_back(variant, snapshot->stats().images);
    status.sequence = follower_->sequence();
    status.damaged = follower_->damaged();
    status.index_m = follower_->index_m();
    status.ready = follower_->ready();
    status.snapshot_sequence = snapshots_.sequence();
    status.began_with_snapshot = follower_->began_with().has_value();
    return status;
}

Result<SearchAnswer> ImageService::search(const QueryPicture& picture,
                                          const SearchOptions& options) {
    if (!ready())
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    Result<SearchPlan> plan = SearchPlan::make(
        picture, options.plan, follower_->snapshots(), follower_->index_m());
    if (!plan) return std::move(plan).error();

    std::optional<image::IdSet> only;
    if (!options.filter.text.empty() || !options.filter.tags.empty()) {
        const auto ids = read(
            [&](schema::ImageStore& images) { return images.matching(options.filter); });
        if (!ids) return ids.error();
        only.emplace(ids.value());
    }
    const IdleCores::Share cores(cores_);
    Result<Found> found = search_images(
        plan.value(), options.limit, only ? &*only : nullptr, cores.executor(), readers_);
    if (!found) return std::move(found).error();
    return SearchAnswer{std::move(plan).value(), std::move(found).value()};
}

Result<QueryPicture> ImageService::stored_picture(
    ImageId id,
    std::span<const image::SignatureKind> kinds,
    bool content) {
    const Result<schema::Image> row = get(id);
    if (!row) return row.error();
    if (row->state != schema::ImageState::kIndexed)
        return Error{ErrorCode::kNotFound,
                     "image " + std::to_string(to_int(id)) + " has no signature",
                     "id"};
    QueryPicture picture;
    picture.log_aspect =
        image::log_aspect(std::max(1, row->width), std::max(1, row->height));
    for (const image::SignatureKind& kind : kinds) {
        Result<image::Signature> found = Error{ErrorCode::kNotFound, ""};
        if (content) found = signature(id, variant_name(kind, ingest::Look::kContent));
        if (!found) found = signature(id, variant_name(kind, ingest::Look::kWhole));
        if (found) {
            picture.signatures[kind] = {std::move(found).value()};
        } else if (found.error().code != ErrorCode::kNotFound) {
            return std::move(found).error();
        }
    }
    return picture;
}

Result<image::Profile> ImageService::profile(std::string_view name) {
    auto connection = readers_.lend();
    if (!connection) return logged(Result<image::Profile>(connection.error()));
    return logged(ingest::find_profile((*connection)->profiles(), name));
}

Result<std::vector<schema::StoredProfile>> ImageService::profiles() {
    return consult([](Connection& connection) { return connection.profiles().list(); });
}

Result<schema::StoredProfile> ImageService::stored_profile(std::string_view name) {
    return consult(
        [&](Connection& connection) { return connection.profiles().get(name); });
}

Result<PutProfile> ImageService::put_profile(const image::Profile& profile) {
    if (image::built_in_profile(profile.name)) return built_in(profile.name);
    return record([&](Connection& connection) -> Result<PutProfile> {
        schema::ProfileStore& profiles = connection.profiles();
        const auto before = profiles.get(profile.name);
        if (!before && before.error().code != ErrorCode::kNotFound) return before.error();
        if (const auto stored = profiles.put(ingest::to_stored(profile)); !stored)
            return stored.error();
        auto after = profiles.get(profile.name);
        if (!after) return std::move(after).error();
        return PutProfile{std::move(after).value(), !before};
    });
}

Result<void> ImageService::remove_profile(std::string_view name) {
    if (image::built_in_profile(name)) return built_in(name);
    return record(
        [&](Connection& connection) { return connection.profiles().remove(name); });
}

Result<ProfileTraining> ImageService::train_profile(const std::vector<QueryPair>& pairs,
                                                    const ProfileFitOptions& options) {
    auto fit = consult(
        [&](Connection& connection) { return fit_profile(connection, pairs, options); });
    if (!fit) return std::move(fit).error();
    const auto stored = record([&](Connection& connection) {
        return store_fit(connection, fit.value(), options);
    });
    if (!stored) return stored.error();
    return ProfileTraining{std::move(fit).value(), stored.value()};
}

Result<std::int64_t> ImageService::add_feedback(const schema::NewFeedback& feedback) {
    return record(
        [&](Connection& connection) { return connection.feedback().add(feedback); });
}

Result<std::vector<schema::Feedback>> ImageService::feedback(
    std::optional<std::string_view> kind,
    std::optional<std::int64_t> after,
    int limit) {
    return consult([&](Connection& connection) {
        return connection.feedback().list(kind, after, limit);
    });
}

Result<void> ImageService::remove_feedback(std::int64_t id) {
    return record(
        [&](Connection& connection) { return connection.feedback().remove(id); });
}

Result<bool> ImageService::lacks(const image::SignatureKind& kind) {
    const std::string variant = ingest::variant_name(kind, ingest::Look::kWhole);
    // Which is a column of every row that can be searched.
    if (variant == ingest::kMainVariant) return false;
    const auto without = read([&](schema::ImageStore& images) {
        return images.without_variant(variant, {}, 1);
    });
    if (!without) return without.error();
    return !without->empty();
}

std::int64_t ImageService::searchable(std::string_view variant) const {
    const Snapshots snapshots = follower_->snapshots();
    const auto found = snapshots.find(variant);
    return found == snapshots.end() ? 0 : found->second->stats().images;
}

Result<std::vector<image::SignatureKind>> ImageService::kinds_in_use() {
    auto connection = readers_.lend();
    if (!connection)
        return logged(Result<std::vector<image::SignatureKind>>(connection.error()));
    return logged(ingest::kinds_in_use((*connection)->profiles()));
}

Result<ImageId> ImageService::add(std::span<const std::uint8_t> picture,
                                  const ImageAttributes& attributes) {
    const auto kinds = kinds_in_use();
    if (!kinds) return kinds.error();
    Result<schema::NewImage> described = pictures_.describe(picture, kinds.value());
    if (!described) return std::move(described).error();
    schema::NewImage& row = described.value();
    row.origin = schema::ImageOrigin::kUpload;
    row.uri = attributes.uri;
    row.tags = attributes.tags;
    row.metadata = attributes.metadata;
    return write([&](schema::ImageStore& images) { return images.add(row); });
}

Result<void> ImageService::remove(ImageId id) {
    return write([&](schema::ImageStore& images) { return images.remove(id); });
}

Result<schema::Image> ImageService::get(ImageId id) {
    return read([&](schema::ImageStore& images) { return images.get(id); });
}

Result<std::vector<schema::Image>> ImageService::list(
    const schema::ListOptions& options) {
    return read([&](schema::ImageStore& images) { return images.list(options); });
}

Result<image::Signature> ImageService::signature(ImageId id) {
    return signature(id, ingest::kMainVariant);
}

Result<image::Signature> ImageService::signature(ImageId id, std::string_view variant) {
    const Result<std::vector<std::uint8_t>> bytes = read([&](schema::ImageStore& images) {
        return variant == ingest::kMainVariant ? images.signature(id)
                                               : images.signature(id, variant);
    });
    if (!bytes) return bytes.error();
    Result<image::Signature> signature = image::decode_signature(bytes.value());
    if (signature) return signature;
    return Error{ErrorCode::kUndecodable,
                 "the stored signature of image " + std::to_string(to_int(id)) +
                     " is damaged: " + signature.error().message};
}

Result<schema::Thumbnail> ImageService::thumbnail(ImageId id) {
    return read([&](schema::ImageStore& images) { return images.thumbnail(id); });
}

void ImageService::stop() {
    follower_->stop();
    snapshots_.save_and_stop();
}

}  // namespace haarmony::server
