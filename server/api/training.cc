#include "server/api/training.h"

#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/api/inputs.h"
#include "server/api/profile_json.h"
#include "server/api/training_pair_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kPage = 1000;

// The newest pairs of that kind that can be read.
Result<std::vector<QueryPair>> logged_pairs(ImageService& images,
                                            const std::string& kind) {
    std::deque<QueryPair> newest;
    std::optional<std::int64_t> after;
    for (;;) {
        const auto page = images.feedback(kind, after, kPage);
        if (!page) return page.error();
        for (const schema::Feedback& feedback : page.value()) {
            after = feedback.id;
            std::optional<QueryPair> pair = stored_pair(feedback);
            if (!pair) continue;
            newest.push_back(*std::move(pair));
            if (newest.size() > kMaxTrainingPairs) newest.pop_front();
        }
        if (page->size() < kPage)
            return std::vector<QueryPair>(std::make_move_iterator(newest.begin()),
                                          std::make_move_iterator(newest.end()));
    }
}

// What is wrong with one of several pairs, named by its place.
http::Problem at_pair(std::size_t i, http::Problem problem) {
    const std::string at = "pairs[" + std::to_string(i) + "]";
    problem.detail = at + ": " + problem.detail;
    problem.param = problem.param.empty() ? at : at + "." + problem.param;
    return problem;
}

std::vector<QueryPair> read_pairs(Inputs& inputs, const json& value) {
    std::vector<QueryPair> pairs;
    if (!value.is_array()) {
        inputs.refuse("pairs", "is not an array of training pairs");
        return pairs;
    }
    for (const json& item : value) {
        auto members = Inputs::of_object(item);
        if (!members) {
            inputs.refuse(at_pair(pairs.size(), members.problem()));
            return pairs;
        }
        auto read = read_pair(*std::move(members));
        if (!read) {
            inputs.refuse(at_pair(pairs.size(), read.problem()));
            return pairs;
        }
        pairs.push_back(std::move(read->pair));
    }
    return pairs;
}

http::Problem untrainable(const Error& error) {
    http::Problem problem = http::problem_of(error);
    const bool about_pairs =
        error.param.starts_with("pairs") || error.param == "mismatches";
    if (error.code == ErrorCode::kInvalidArgument && about_pairs) {
        problem.status = 422;
        problem.code = "untrainable";
    }
    return problem;
}

json summary_json(const image::RankSummary& summary) {
    return {{"median_rank", summary.median},
            {"mean_rank", summary.mean},
            {"rank_1", summary.first},
            {"top_20", summary.top_20},
            {"top_1_percent", summary.top_percent},
            {"mrr", summary.mean_reciprocal_rank}};
}

json reply_json(const ProfileTraining& training) {
    const image::TrainingReport& report = training.fit.report;
    const image::HeldBackRanks& held_back = report.held_back;
    const image::Calibration& calibration = *report.profile.calibration;
    json fit{{"raw", report.raw},
             {"clamped", report.clamped},
             {"log_likelihood", report.log_likelihood},
             {"null_log_likelihood", report.null_log_likelihood},
             {"iterations", report.iterations},
             {"converged", report.converged},
             {"pairs", report.fitted_pairs},
             {"left_out", training.fit.left_out},
             {"mismatches", report.mismatches},
             {"intercept", calibration.intercept},
             {"scale", calibration.scale}};
    json ranks{{"pairs", held_back.pairs.size()},
               {"candidates", held_back.candidates},
               {"before", summary_json(held_back.before_summary)},
               {"after", summary_json(held_back.after_summary)},
               {"existing", nullptr}};
    if (training.fit.existing) ranks["existing"] = summary_json(*training.fit.existing);
    return {{"profile", report.profile.name},
            {"weights", weights_json(report.profile.weights)},
            {"fit", std::move(fit)},
            {"held_back", std::move(ranks)},
            {"better", report.better},
            {"stored", training.stored}};
}

}  // namespace

Reply post_training(const Context& context, const http::Request& request) {
    ProfileFitOptions options;
    options.name = request.path_parameters.at("name");
    if (auto problem = refuse_name(options.name)) return *std::move(problem);
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    if (inputs->picture())
        return Error{ErrorCode::kUnsupportedFormat, "a picture is no training", "file"};
    options.base = inputs->text("base").value_or(options.base);
    options.replace_worse = inputs->boolean("replace_worse").value_or(false);
    options.seed = static_cast<std::uint64_t>(
        inputs->integer("seed", 0, std::numeric_limits<std::int64_t>::max()).value_or(1));
    const std::string kind = inputs->text("kind").value_or("painted");
    std::optional<std::vector<QueryPair>> pairs;
    if (const auto given = inputs->member("pairs")) pairs = read_pairs(*inputs, *given);
    if (const auto problem = inputs->refused()) return *problem;

    if (!pairs) {
        auto logged = logged_pairs(context.images, kind);
        if (!logged) return logged.error();
        pairs = std::move(logged).value();
        options.unusable = Unusable::kLeftOut;
    }
    const auto training = context.images.train_profile(*pairs, options);
    if (!training) return untrainable(training.error());
    http::Response response = http::json_response(200, reply_json(training.value()));
    response.headers["Cache-Control"] = "no-store";
    return response;
}

}  // namespace haarmony::server
