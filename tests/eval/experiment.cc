#include "tests/eval/experiment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace haarmony::eval {
namespace {

// FNV-1a: the same on every machine, which std::hash is not.
std::uint64_t stream_of(std::string_view name) {
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : name) {
        hash ^= static_cast<std::uint8_t>(c);
        hash *= 1099511628211U;
    }
    return hash;
}

RgbPicture at_most(const RgbPicture& picture, int side) {
    const int longest = std::max(picture.width, picture.height);
    if (longest <= side) return picture;
    const auto scaled = [&](int length) {
        return std::max(1,
                        static_cast<int>(std::lround(double(length) * side / longest)));
    };
    return resize(picture, scaled(picture.width), scaled(picture.height));
}

}  // namespace

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) {
        std::swap(order[i - 1], order[random.below(static_cast<int>(i))]);
    }
    return order;
}

Result<Experiment> Experiment::prepare(const PictureSource& source,
                                       const Database& database,
                                       std::uint64_t seed,
                                       int queries,
                                       Executor& executor) {
    assert(queries >= 1 && database.size() >= 2);
    Experiment experiment;
    experiment.database_ = &database;
    experiment.executor_ = &executor;
    experiment.seed_ = seed;

    const std::size_t pictures = database.names.size();
    Random random = experiment.random("order of the pictures", 0);
    const std::vector<std::size_t> order = shuffled(pictures, random);
    const auto first = [&](std::size_t count) {
        return std::vector(order.begin(), order.begin() + std::ptrdiff_t(count));
    };
    experiment.evaluation_ = first(std::min<std::size_t>(queries, pictures));
    experiment.distorted_ = first(std::min<std::size_t>(kDistortedPictures, pictures));
    const std::size_t fitted = std::min<std::size_t>(pictures / 2, kFittingQueries);
    const std::size_t selected =
        std::min<std::size_t>(pictures - fitted, kSelectionQueries);
    const auto last = order.rbegin();
    experiment.fitting_.assign(last, last + std::ptrdiff_t(fitted));
    experiment.selection_.assign(last + std::ptrdiff_t(fitted),
                                 last + std::ptrdiff_t(fitted + selected));
    experiment.training_overlaps_ =
        experiment.evaluation_.size() + fitted + selected > pictures;

    std::set<std::size_t> wanted;
    for (const auto* set : {&experiment.evaluation_,
                            &experiment.distorted_,
                            &experiment.fitting_,
                            &experiment.selection_}) {
        wanted.insert(set->begin(), set->end());
    }
    const std::vector<std::size_t> places(wanted.begin(), wanted.end());
    std::vector<std::optional<Result<RgbPicture>>> loaded(places.size());
    executor.parallel_for(places.size(), [&](std::size_t i) {
        loaded[i] = source.load(database.source_places[places[i]]);
        if (loaded[i]->has_value()) loaded[i] = at_most(loaded[i]->value(), kQuerySide);
    });
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!*loaded[i]) return loaded[i]->error();
        experiment.pictures_.emplace(places[i], std::move(*loaded[i]).value());
    }
    return experiment;
}

const RgbPicture& Experiment::picture(std::size_t place) const {
    const auto found = pictures_.find(place);
    assert(found != pictures_.end());
    return found->second;
}

Random Experiment::random(std::string_view protocol, std::size_t place) const {
    return Random(
        gallery::mix_seeds(gallery::mix_seeds(seed_, stream_of(protocol)), place));
}

QueryPicture Experiment::query(QueryKind kind, std::size_t place) const {
    Random stream = random(query_kind_name(kind), place);
    return simulate(kind, picture(place), stream);
}

}  // namespace haarmony::eval
