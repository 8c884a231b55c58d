// All that the daemon can do with pictures, without HTTP: the database, the index that
// follows it, and the decoders behind one interface.
//
//   server/api -> [image_service] -> index_follower, image_search, picture_reader
//
// A write is visible to the next search and the next read when it returns.
//
// Errors   the stores' and the decoder's; kUnavailable from search() until ready().
// Threads  every member from any thread. Reads borrow a connection each, writes follow one
//          another on one; nothing is locked while decoding or scoring.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/image/profile.h"
#include "engine/image/signature.h"
#include "ingest/decode.h"
#include "schema/image_store.h"
#include "server/app/connection.h"
#include "server/app/idle_cores.h"
#include "server/app/image_search.h"
#include "server/app/index_follower.h"
#include "server/app/picture_reader.h"
#include "server/app/profile_training.h"
#include "server/app/snapshot_keeper.h"

namespace haarmony::server {

struct ImageServiceOptions {
    std::string database_path;
    int index_m = 60;
    std::chrono::milliseconds poll_interval{25};
    ingest::DecodeLimits decode;
    // That searches may use, their own threads included; loading the index has all of them.
    int search_cores = 1;
};

struct SearchOptions {
    PlanOptions plan;
    int limit = 20;
    schema::ImageFilter filter;  // only pictures that match it; empty: all
};

struct SearchAnswer {
    SearchPlan plan;
    Found found;
};

// What a client says about a picture, beside its pixels.
struct ImageAttributes {
    std::string uri;
    std::vector<std::string> tags;
    std::string metadata = "{}";
};

struct ServiceStatus {
    schema::Counts rows;
    image::IndexStats index;  // of all variants together
    std::vector<std::pair<std::string, std::int64_t>> variants;  // live pictures in each
    std::int64_t sequence = 0;
    std::int64_t damaged = 0;
    int index_m = 0;
    bool ready = false;
    // The last change in the snapshot file, and whether the index was taken from it.
    std::optional<std::int64_t> snapshot_sequence;
    bool began_with_snapshot = false;
};

struct PutProfile {
    schema::StoredProfile profile;
    bool created = false;  // no profile had that name
};

struct ProfileTraining {
    ProfileFit fit;
    bool stored = false;
};

class ImageService {
  public:
    // Creates or migrates the database and starts to load it.
    [[nodiscard]] static Result<std::unique_ptr<ImageService>> open(
        const ImageServiceOptions& options);

    [[nodiscard]] bool ready() const { return follower_->ready(); }
    [[nodiscard]] Result<ServiceStatus> status();

    [[nodiscard]] PictureReader& pictures() { return pictures_; }
    // The indexes themselves, for those who search them in their own way.
    [[nodiscard]] const IndexFollower& index() const { return *follower_; }
    [[nodiscard]] SnapshotKeeper& snapshots() { return snapshots_; }

    [[nodiscard]] Result<SearchAnswer> search(const QueryPicture& picture,
                                              const SearchOptions& options);
    // A stored picture as a query, in those kinds that are there. With `content`, what is
    // within its borders where it has borders.
    [[nodiscard]] Result<QueryPicture>
    stored_picture(ImageId id, std::span<const image::SignatureKind> kinds, bool content);

    // A built-in profile or a stored one, as it is now; kNotFound naming it.
    [[nodiscard]] Result<image::Profile> profile(std::string_view name);
    // The stored ones, in the order of names, those that the engine does not know too.
    [[nodiscard]] Result<std::vector<schema::StoredProfile>> profiles();
    // kNotFound naming it, for a built-in one too.
    [[nodiscard]] Result<schema::StoredProfile> stored_profile(std::string_view name);
    // Inserts or replaces. kConflict for the name of a built-in profile, here and below.
    [[nodiscard]] Result<PutProfile> put_profile(const image::Profile& profile);
    [[nodiscard]] Result<void> remove_profile(std::string_view name);
    // Fits and, where it may be, stores (profile_training.h).
    [[nodiscard]] Result<ProfileTraining> train_profile(
        const std::vector<QueryPair>& pairs,
        const ProfileFitOptions& options);

    // Training pairs, as schema/feedback_store.h.
    [[nodiscard]] Result<std::int64_t> add_feedback(const schema::NewFeedback& feedback);
    [[nodiscard]] Result<std::vector<schema::Feedback>> feedback(
        std::optional<std::string_view> kind,
        std::optional<std::int64_t> after,
        int limit);
    [[nodiscard]] Result<void> remove_feedback(std::int64_t id);

    // Whether some picture that can be searched has no signature of that kind.
    [[nodiscard]] Result<bool> lacks(const image::SignatureKind& kind);
    // How many pictures the index of that variant (ingest/variant.h) can find.
    [[nodiscard]] std::int64_t searchable(std::string_view variant) const;

    [[nodiscard]] Result<ImageId> add(std::span<const std::uint8_t> picture,
                                      const ImageAttributes& attributes);
    [[nodiscard]] Result<void> remove(ImageId id);

    [[nodiscard]] Result<schema::Image> get(ImageId id);
    [[nodiscard]] Result<std::vector<schema::Image>> list(
        const schema::ListOptions& options);
    // kUndecodable where the stored bytes are damaged.
    [[nodiscard]] Result<image::Signature> signature(ImageId id);
    [[nodiscard]] Result<image::Signature> signature(ImageId id,
                                                     std::string_view variant);
    [[nodiscard]] Result<schema::Thumbnail> thumbnail(ImageId id);

    // Ends the background threads and writes a snapshot of what has changed; the index
    // answers as it is.
    void stop();

  private:
    ImageService(const ImageServiceOptions& options,
                 std::unique_ptr<Connection> writer,
                 std::unique_ptr<IndexFollower> follower);

    [[nodiscard]] Result<std::vector<image::SignatureKind>> kinds_in_use();

    // Runs `work` alone on the writing connection and brings the index up to it.
    template <typename Work>
    auto write(Work&& work);
    template <typename Work>
    auto read(Work&& work);
    // The same for what no search finds: `work` gets the connection.
    template <typename Work>
    auto record(Work&& work);
    template <typename Work>
    auto consult(Work&& work);

    std::mutex writer_mutex_;  // guards writer_
    std::unique_ptr<Connection> writer_;
    ReadConnections readers_;
    std::unique_ptr<IndexFollower> follower_;
    SnapshotKeeper snapshots_;
    PictureReader pictures_;
    IdleCores cores_;
};

}  // namespace haarmony::server
