#include "server/app/profile_training.h"

#include <algorithm>
#include <random>
#include <span>
#include <utility>

#include "engine/image/random_order.h"
#include "engine/image/signature_codec.h"
#include "ingest/stored_profile.h"
#include "ingest/variant.h"
#include "server/app/query_picture.h"

namespace haarmony::server {
namespace {

using image::Signature;
using image::SignatureKind;

// The stored signature of that kind, of the whole picture.
Result<Signature> stored_signature(schema::ImageStore& images,
                                   ImageId id,
                                   const SignatureKind& kind) {
    const std::string variant = ingest::variant_name(kind, ingest::Look::kWhole);
    const Result<std::vector<std::uint8_t>> bytes = variant == ingest::kMainVariant
                                                        ? images.signature(id)
                                                        : images.signature(id, variant);
    if (!bytes) return bytes.error();
    Result<Signature> signature = image::decode_signature(bytes.value());
    if (signature) return signature;
    return Error{ErrorCode::kUndecodable,
                 "the stored signature of image " + std::to_string(to_int(id)) +
                     " is damaged: " + signature.error().message};
}

Result<Signature> target_signature(schema::ImageStore& images,
                                   ImageId id,
                                   const SignatureKind& kind) {
    Result<Signature> signature = stored_signature(images, id, kind);
    if (signature || signature.error().code != ErrorCode::kNotFound) return signature;
    // There is the picture, or there is the signature that is missing.
    if (const auto row = images.get(id); !row) return row.error();
    return Error{ErrorCode::kConflict,
                 "image " + std::to_string(to_int(id)) +
                     " has no signature of the kind " + image::kind_name(kind) +
                     ": a job of the type 'reindex' makes it"};
}

bool has_coefficients(const Signature& signature) {
    return std::ranges::any_of(signature.channels,
                               [](const auto& channel) { return channel.count > 0; });
}

// The query as the profile compares it.
Result<Signature> query_signature(const QueryPair& pair, const SignatureKind& kind) {
    const auto checked = [](const Signature& signature) -> Result<Signature> {
        if (!signature.low_information && has_coefficients(signature)) return signature;
        return Error{ErrorCode::kInvalidArgument, "the query has no information"};
    };
    if (pair.signature && pair.signature->kind == kind) return checked(*pair.signature);
    if (!pair.strokes)
        return Error{ErrorCode::kInvalidArgument,
                     "the signature is of the kind " +
                         image::kind_name(pair.signature->kind) +
                         ", and the profile compares " + image::kind_name(kind)};
    const image::Raster painted = image::rasterize(*pair.strokes);
    const ImageView view = painted.view();
    const QueryPicture picture =
        look_at(view, view.width, view.height, {.kinds = {kind}});
    // One: the drawing is no part of something larger.
    return checked(picture.signatures.at(kind).front());
}

Result<image::TrainingPair> training_pair(schema::ImageStore& images,
                                          const QueryPair& pair,
                                          const SignatureKind& kind) {
    Result<Signature> query = query_signature(pair, kind);
    if (!query) return std::move(query).error();
    Result<Signature> target = target_signature(images, pair.target, kind);
    if (!target) return std::move(target).error();
    return image::TrainingPair{std::move(query).value(), std::move(target).value()};
}

// Failures of the database are nobody's pair.
bool is_the_pairs_fault(const Error& error) {
    return error.code != ErrorCode::kIo && error.code != ErrorCode::kUnavailable;
}

Result<std::vector<image::TrainingPair>> material(schema::ImageStore& images,
                                                  const std::vector<QueryPair>& pairs,
                                                  const SignatureKind& kind,
                                                  Unusable unusable) {
    std::vector<image::TrainingPair> usable;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        Result<image::TrainingPair> pair = training_pair(images, pairs[i], kind);
        if (pair) {
            usable.push_back(std::move(pair).value());
            continue;
        }
        Error error = std::move(pair).error();
        if (!is_the_pairs_fault(error)) return error;
        if (unusable == Unusable::kLeftOut) continue;
        error.message = "pair " + std::to_string(i + 1) + ": " + error.message;
        error.param = "pairs[" + std::to_string(i) + "]";
        return error;
    }
    return usable;
}

// Those of up to kMaxMismatches pictures of the collection.
Result<std::vector<Signature>> sample(schema::ImageStore& images,
                                      const SignatureKind& kind,
                                      std::uint64_t seed) {
    std::vector<ImageId> ids;
    const auto scanned = images.for_each_searchable(
        [&](const schema::SearchableImage& image) { ids.push_back(image.id); });
    if (!scanned) return scanned.error();
    std::mt19937_64 random(seed);
    image::draw_to_front(random, std::span(ids), ids.size());
    std::vector<Signature> signatures;
    for (const ImageId id : ids) {
        if (signatures.size() == kMaxMismatches) break;
        Result<Signature> signature = stored_signature(images, id, kind);
        if (signature) {
            signatures.push_back(std::move(signature).value());
        } else if (!is_the_pairs_fault(signature.error())) {
            return std::move(signature).error();
        }
    }
    return signatures;
}

Result<image::Profile> base_profile(schema::ProfileStore& profiles,
                                    const std::string& name) {
    Result<image::Profile> base = ingest::find_profile(profiles, name);
    if (base || base.error().code != ErrorCode::kNotFound) return base;
    return Error{
        ErrorCode::kInvalidArgument, "there is no profile '" + name + "'", "base"};
}

Error too_few(std::size_t usable, std::size_t given) {
    const std::string of =
        usable == given ? "" : " of " + std::to_string(given) + " can be learned from";
    return {ErrorCode::kInvalidArgument,
            std::to_string(usable) + " pairs" + of + ": at least " +
                std::to_string(image::kMinTrainingPairs) + " are needed",
            "pairs"};
}

// The profile that has the name now; nothing where none has.
Result<std::optional<schema::StoredProfile>> existing_profile(
    schema::ProfileStore& profiles,
    const std::string& name) {
    Result<schema::StoredProfile> stored = profiles.get(name);
    if (stored) return std::optional(std::move(stored).value());
    if (stored.error().code != ErrorCode::kNotFound) return std::move(stored).error();
    return std::optional<schema::StoredProfile>();
}

image::RankSummary held_back_summary(const image::TrainingReport& report,
                                     const std::vector<image::TrainingPair>& pairs,
                                     const std::vector<Signature>& mismatches,
                                     const image::Profile& profile) {
    std::vector<image::TrainingPair> held_back;
    for (const std::size_t i : report.held_back.pairs) held_back.push_back(pairs[i]);
    return image::summarize(image::target_ranks(held_back, mismatches, profile),
                            report.held_back.candidates);
}

}  // namespace

Result<ProfileFit> fit_profile(Connection& connection,
                               const std::vector<QueryPair>& pairs,
                               const ProfileFitOptions& options) {
    if (image::built_in_profile(options.name))
        return Error{
            ErrorCode::kConflict,
            "the profile '" + options.name + "' is built in: it cannot be trained",
            "name"};
    const auto base = base_profile(connection.profiles(), options.base);
    if (!base) return base.error();
    constexpr auto kLeast = static_cast<std::size_t>(image::kMinTrainingPairs);
    if (pairs.size() < kLeast) return too_few(pairs.size(), pairs.size());
    if (pairs.size() > kMaxTrainingPairs)
        return Error{ErrorCode::kInvalidArgument,
                     std::to_string(pairs.size()) + " pairs: at most " +
                         std::to_string(kMaxTrainingPairs) + " can be learned from",
                     "pairs"};

    const auto usable =
        material(connection.images(), pairs, base->kind, options.unusable);
    if (!usable) return usable.error();
    if (usable->size() < kLeast) return too_few(usable->size(), pairs.size());
    const auto mismatches = sample(connection.images(), base->kind, options.seed);
    if (!mismatches) return mismatches.error();
    image::TrainingOptions training;
    training.seed = options.seed;
    Result<image::TrainingReport> report =
        image::train(usable.value(), mismatches.value(), base.value(), training);
    if (!report) return std::move(report).error();

    ProfileFit fit;
    fit.report = std::move(report).value();
    fit.report.profile.name = options.name;
    fit.left_out = pairs.size() - usable->size();
    fit.worse = !fit.report.better;
    const auto existing = existing_profile(connection.profiles(), options.name);
    if (!existing) return existing.error();
    if (!existing->has_value()) return fit;
    fit.existing_revision = (*existing)->revision;
    const Result<image::Profile> profile = ingest::from_stored(**existing);
    if (profile && profile->kind == base->kind)
        fit.existing = held_back_summary(
            fit.report, usable.value(), mismatches.value(), profile.value());
    if (!fit.existing ||
        !image::keeps_up(*fit.existing, fit.report.held_back.after_summary))
        fit.worse = true;
    return fit;
}

Result<bool> store_fit(Connection& connection,
                       const ProfileFit& fit,
                       const ProfileFitOptions& options) {
    const auto existing = existing_profile(connection.profiles(), options.name);
    if (!existing) return existing.error();
    if (existing->has_value() && !options.replace_worse) {
        if ((*existing)->revision != fit.existing_revision)
            return Error{ErrorCode::kConflict,
                         "the profile '" + options.name +
                             "' was changed during the training: train again",
                         "name"};
        if (fit.worse) return false;
    }
    const auto stored = connection.profiles().put(ingest::to_stored(fit.report.profile));
    if (!stored) return stored.error();
    return true;
}

}  // namespace haarmony::server
