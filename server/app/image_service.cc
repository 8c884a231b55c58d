#include "server/app/image_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "engine/image/query.h"
#include "engine/image/signature_codec.h"
#include "server/app/log_value.h"

namespace haarmony::server {
namespace {

// What the client only sees as "the server could not answer".
template <typename Answer>
Answer logged(Answer answer) {
    if (!answer && answer.error().code == ErrorCode::kIo)
        spdlog::error("event=database_failed reason={}",
                      log_value(answer.error().message));
    return answer;
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
      pictures_(options.decode) {}

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

Result<ServiceStatus> ImageService::status() {
    const Result<schema::Counts> rows =
        read([](schema::ImageStore& images) { return images.counts(); });
    if (!rows) return rows.error();
    ServiceStatus status;
    status.rows = rows.value();
    status.index = follower_->snapshot()->stats();
    status.sequence = follower_->sequence();
    status.damaged = follower_->damaged();
    status.index_m = follower_->index_m();
    status.ready = follower_->ready();
    return status;
}

Result<SearchAnswer> ImageService::search(const image::Signature& signature,
                                          const SearchOptions& options) {
    if (!ready())
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    const int m = std::min(options.m.value_or(options.profile.m), follower_->index_m());
    const image::Query query = image::make_query(signature, options.profile, m);
    Result<Found> found = search_images(
        *follower_->snapshot(), query, options.limit, options.min_similarity, readers_);
    if (!found) return std::move(found).error();
    return SearchAnswer{std::move(found).value(), m};
}

Result<ImageId> ImageService::add(std::span<const std::uint8_t> picture,
                                  const ImageAttributes& attributes) {
    Result<schema::NewImage> described = pictures_.describe(picture);
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
    const Result<std::vector<std::uint8_t>> bytes =
        read([&](schema::ImageStore& images) { return images.signature(id); });
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

void ImageService::stop() { follower_->stop(); }

}  // namespace haarmony::server
