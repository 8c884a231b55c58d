#include "server/app/reindex_job.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/signature_kind.h"
#include "ingest/byte_budget.h"
#include "ingest/describe.h"
#include "ingest/file_uri.h"
#include "ingest/media_fragment.h"
#include "ingest/read_file.h"
#include "ingest/stored_profile.h"
#include "ingest/variant.h"

namespace haarmony::server {
namespace {

using image::SignatureKind;
using nlohmann::json;
using Kinds = std::vector<SignatureKind>;

constexpr int kPage = 64;
// A commit costs a flush of the disk, so that several pictures share one.
constexpr std::size_t kBatch = 16;
constexpr std::chrono::milliseconds kBatchAge{250};
constexpr std::int64_t kMaxFileBytes = std::int64_t{1} << 30;

struct Request {
    Kinds kinds;
    bool all = false;
};

std::optional<SignatureKind> named_kind(const json& request) {
    const auto space =
        image::color_space_from_name(request.value("color_space", std::string("yiq")));
    const auto decomposition = image::decomposition_from_name(
        request.value("decomposition", std::string("standard")));
    if (!space || !decomposition) return {};
    return SignatureKind{*space, *decomposition};
}

Result<Request> read_request(const std::string& text, schema::ProfileStore& profiles) {
    const json request = json::parse(text, nullptr, false);
    const auto is_text = [&](const char* name) {
        return !request.contains(name) || request[name].is_string();
    };
    const Error not_understood{ErrorCode::kInvalidArgument,
                               "the request " + text + " is not understood"};
    if (!request.is_object() || !is_text("profile") || !is_text("color_space") ||
        !is_text("decomposition") ||
        (request.contains("all") && !request["all"].is_boolean()))
        return not_understood;
    Request wanted;
    wanted.all = request.value("all", false);
    if (request.contains("profile")) {
        const auto profile =
            ingest::find_profile(profiles, request["profile"].get<std::string>());
        if (!profile) return profile.error();
        wanted.kinds = {profile->kind};
    } else if (request.contains("color_space") || request.contains("decomposition")) {
        const auto kind = named_kind(request);
        if (!kind) return not_understood;
        wanted.kinds = {*kind};
    }
    // Nobody asked for one kind; or for the first signature anew, which every other one of
    // the picture goes with.
    if (wanted.kinds.empty() || (wanted.all && wanted.kinds.front() == SignatureKind{})) {
        auto kinds = ingest::kinds_in_use(profiles);
        if (!kinds) return kinds.error();
        wanted.kinds = std::move(kinds).value();
    }
    return wanted;
}

std::optional<ImageId> id_of(const std::string& position) {
    std::int64_t id = 0;
    const char* end = position.data() + position.size();
    const auto parsed = std::from_chars(position.data(), end, id);
    if (parsed.ec != std::errc() || parsed.ptr != end) return {};
    return ImageId{id};
}

// Why nothing came of one picture; the job goes on.
struct Failure {
    std::string reason;
};

// Neither an upload has one, nor a frame of a film.
bool has_original(const schema::Image& row) {
    return row.origin == schema::ImageOrigin::kFile && !ingest::is_key_frame_uri(row.uri);
}

class Reindexing {
  public:
    Reindexing(JobContext& job, Request request, const ingest::DecodeLimits& limits)
        : job_(job),
          images_(job.connection().images()),
          request_(std::move(request)),
          decoder_(limits) {}

    Result<void> run();

  private:
    using Clock = std::chrono::steady_clock;
    using Write = std::function<Result<void>()>;

    // What is to be written of a picture, unless it has become another one since.
    struct Pending {
        schema::Image row;
        Write write;
    };

    Result<void> renew(const schema::Image& row);
    Result<Kinds> lacking(const schema::Image& row);
    Result<std::vector<std::uint8_t>> original(const schema::Image& row,
                                               std::optional<Failure>& failure);
    Result<void> failed(const schema::Image& row, const std::string& reason);
    // Commits what is pending: all that was seen up to `last` is done with.
    Result<void> commit(ImageId last);
    [[nodiscard]] bool commit_is_due() const;
    Result<bool> is_as_it_was(const schema::Image& row);

    JobContext& job_;
    schema::ImageStore& images_;
    const Request request_;
    ingest::Decoder decoder_;
    ingest::ByteBudget budget_{kMaxFileBytes};
    std::vector<Pending> pending_;
    Clock::time_point committed_ = Clock::now();
};

Result<void> Reindexing::run() {
    const Result<schema::Counts> rows = images_.counts();
    if (!rows) return rows.error();
    job_.set_total(rows->indexed);
    schema::ListOptions page;
    page.limit = kPage;
    page.after = id_of(job_.position());
    for (;;) {
        const Result<std::vector<schema::Image>> pictures = images_.list(page);
        if (!pictures) return pictures.error();
        if (pictures->empty()) return {};
        for (const schema::Image& row : pictures.value()) {
            if (job_.cancelled())
                return page.after ? commit(*page.after) : Result<void>();
            if (Result<void> renewed = renew(row); !renewed) return renewed;
            ++job_.counts().seen;
            page.after = row.id;
            if (!commit_is_due()) continue;
            if (Result<void> done = commit(row.id); !done) return done;
        }
        if (Result<void> done = commit(*page.after); !done) return done;
    }
}

bool Reindexing::commit_is_due() const {
    return pending_.size() >= kBatch || Clock::now() - committed_ >= kBatchAge;
}

Result<void> Reindexing::commit(ImageId last) {
    schema::JobCounts counts = job_.counts();
    if (!pending_.empty()) {
        const Result<void> stored = images_.transaction([&]() -> Result<void> {
            for (const Pending& pending : pending_) {
                const Result<bool> same = is_as_it_was(pending.row);
                if (!same) return same.error();
                ++(*same ? counts.updated : counts.skipped);
                if (!*same) continue;
                if (Result<void> written = pending.write(); !written) return written;
            }
            return {};
        });
        if (!stored) return stored;
        pending_.clear();
    }
    committed_ = Clock::now();
    job_.counts() = counts;
    job_.set_position(std::to_string(to_int(last)));
    job_.progress();
    return {};
}

// Not deleted, replaced or ingested anew since `row` was read.
Result<bool> Reindexing::is_as_it_was(const schema::Image& row) {
    const Result<schema::Image> now = images_.get(row.id);
    if (!now && now.error().code != ErrorCode::kNotFound) return now.error();
    return now && now->state == schema::ImageState::kIndexed &&
           now->stamp.content_hash == row.stamp.content_hash;
}

Result<void> Reindexing::failed(const schema::Image& row, const std::string& reason) {
    job_.fail("image " + std::to_string(to_int(row.id)) + ": " + reason);
    return {};
}

Result<Kinds> Reindexing::lacking(const schema::Image& row) {
    Kinds kinds;
    for (const SignatureKind& kind : request_.kinds) {
        const std::string variant = ingest::variant_name(kind, ingest::Look::kWhole);
        if (variant == ingest::kMainVariant) continue;
        const auto stored = images_.signature(row.id, variant);
        if (!stored && stored.error().code != ErrorCode::kNotFound) return stored.error();
        if (!stored) kinds.push_back(kind);
    }
    return kinds;
}

// The bytes that the picture's signatures are made of.
Result<std::vector<std::uint8_t>> Reindexing::original(const schema::Image& row,
                                                       std::optional<Failure>& failure) {
    if (!has_original(row)) {
        Result<schema::Thumbnail> thumbnail = images_.thumbnail(row.id);
        if (thumbnail) return std::move(thumbnail->bytes);
        if (thumbnail.error().code != ErrorCode::kNotFound) return thumbnail.error();
        failure = Failure{"it has no thumbnail"};
        return std::vector<std::uint8_t>();
    }
    const Result<std::string> path = ingest::path_from_file_uri(row.uri);
    if (!path) {
        failure = Failure{"its address names no file"};
        return std::vector<std::uint8_t>();
    }
    ingest::ReadLimits limits;
    limits.max_bytes = kMaxFileBytes;
    Result<ingest::FileContent> file = ingest::read_file(path.value(), limits, budget_);
    if (!file) {
        failure = Failure{file.error().code == ErrorCode::kNotFound
                              ? "the file is gone"
                              : "the file cannot be read"};
        return std::vector<std::uint8_t>();
    }
    if (ingest::content_hash(file->bytes) != row.stamp.content_hash)
        failure = Failure{"changed since it was ingested; ingest it again"};
    return std::move(file->bytes);
}

Result<void> Reindexing::renew(const schema::Image& row) {
    Result<Kinds> missing = lacking(row);
    if (!missing) return missing.error();
    const bool anew = request_.all && has_original(row);
    const Kinds& kinds = anew ? request_.kinds : missing.value();
    if (kinds.empty()) {
        ++job_.counts().skipped;
        return {};
    }
    std::optional<Failure> failure;
    const auto bytes = original(row, failure);
    if (!bytes) return bytes.error();
    if (failure) return failed(row, failure->reason);

    // The first signature and all that goes with it.
    if (kinds.front() == SignatureKind{}) {
        Result<schema::NewImage> described =
            ingest::describe(decoder_, bytes.value(), kinds);
        if (!described) return failed(row, described.error().message);
        described->origin = row.origin;
        described->uri = row.uri;
        described->stamp = row.stamp;
        pending_.push_back({row, [this, id = row.id, image = std::move(*described)] {
                                return images_.update(id, image);
                            }});
        return {};
    }
    const Result<ingest::Picture> picture = decoder_.decode(bytes.value());
    if (!picture) return failed(row, picture.error().message);
    pending_.push_back({row,
                        [this,
                         id = row.id,
                         variants = ingest::signature_variants(picture->view(),
                                                               kinds)]() -> Result<void> {
                            for (const schema::SignatureVariant& variant : variants)
                                if (Result<void> set = images_.set_variant(id, variant);
                                    !set)
                                    return set;
                            return {};
                        }});
    return {};
}

}  // namespace

JobType reindex_job(const ingest::DecodeLimits& limits) {
    return {[limits](JobContext& job) -> Result<void> {
                Result<Request> request =
                    read_request(job.request(), job.connection().profiles());
                if (!request) return request.error();
                return Reindexing(job, std::move(request).value(), limits).run();
            },
            true};
}

}  // namespace haarmony::server
