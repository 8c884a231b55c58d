#include "tests/eval/figure_4_5.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/image/training.h"
#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/rank_table.h"
#include "tests/eval/ranking.h"

namespace haarmony::eval {
namespace {

constexpr std::array kQueries = {QueryKind::kScanned,
                                 QueryKind::kPainted,
                                 QueryKind::kHalfPainted};
constexpr std::array kSpaces = {image::ColorSpace::kRgb,
                                image::ColorSpace::kHsv,
                                image::ColorSpace::kYiq,
                                image::ColorSpace::kLab,
                                image::ColorSpace::kLuv};
constexpr std::array kDecompositions = {image::Decomposition::kStandard,
                                        image::Decomposition::kNonstandard};
constexpr std::array kRules = {image::BinRule::kLog2Plus1,
                               image::BinRule::kLinear,
                               image::BinRule::kLiteral};

// The signatures of queries: by kind of signature, then in the order of `places`.
using Signatures = std::map<image::SignatureKind, std::vector<image::Signature>>;

Signatures describe(const Experiment& experiment,
                    QueryKind query,
                    const std::vector<std::size_t>& places) {
    std::vector<std::vector<image::Signature>> by_place(places.size());
    experiment.executor().parallel_for(places.size(), [&](std::size_t i) {
        by_place[i] = image::make_signatures(experiment.query(query, places[i]).view(),
                                             all_kinds());
    });
    Signatures signatures;
    for (const auto& of_place : by_place) {
        for (const image::Signature& signature : of_place)
            signatures[signature.kind].push_back(signature);
    }
    return signatures;
}

// What is known of one kind of query.
struct Material {
    image::Profile base;  // the built-in profile for such queries
    Signatures fitting;
    Signatures selection;
    Signatures evaluation;
};

using Searches = std::map<image::SignatureKind, std::unique_ptr<WaveletSearch>>;

RankSummary summary_of(const Experiment& experiment,
                       const WaveletSearch& search,
                       const image::Profile& profile,
                       const std::vector<image::Signature>& queries,
                       const std::vector<std::size_t>& targets) {
    std::vector<std::int64_t> ranks;
    for (std::size_t i = 0; i < targets.size(); ++i)
        ranks.push_back(search.rank(queries[i], profile, targets[i]));
    return summarize(ranks, experiment.database().size());
}

Result<image::Profile> fitted(const Experiment& experiment,
                              const Signatures& queries,
                              const image::Profile& base) {
    const auto& pictures = experiment.database().signatures.at(base.kind);
    const auto& of_kind = queries.at(base.kind);
    std::vector<image::TrainingPair> pairs;
    for (std::size_t i = 0; i < of_kind.size(); ++i)
        pairs.push_back({of_kind[i], pictures[experiment.fitting()[i]]});
    image::TrainingOptions options;
    options.held_back_share = 0.1;
    options.seed = experiment.seed();
    Result<image::TrainingReport> report = image::train(pairs, pictures, base, options);
    if (!report) return report.error();
    return std::move(report->profile);
}

// All combinations, with their built-in weights; the fitted ones follow the same order.
std::vector<ChoicePoint> combinations(QueryKind query,
                                      const image::Profile& base,
                                      const std::vector<int>& ms) {
    std::vector<ChoicePoint> points;
    for (const image::BinRule rule : kRules) {
        for (const image::SignatureKind& kind : all_kinds()) {
            for (const int m : ms) {
                ChoicePoint point{query, base, false, {}};
                point.profile.kind = kind;
                point.profile.bin_rule = rule;
                point.profile.m = m;
                points.push_back(std::move(point));
            }
        }
    }
    return points;
}

struct Measured {
    const Experiment& experiment;
    const Searches& searches;
    const Material& material;

    [[nodiscard]] RankSummary selection(const image::Profile& profile) const {
        return summary_of(experiment,
                          *searches.at(profile.kind),
                          profile,
                          material.selection.at(profile.kind),
                          experiment.selection());
    }
    [[nodiscard]] RankSummary evaluation(const image::Profile& profile) const {
        return summary_of(experiment,
                          *searches.at(profile.kind),
                          profile,
                          material.evaluation.at(profile.kind),
                          experiment.evaluation());
    }
    [[nodiscard]] Winner winner(const char* among, const ChoicePoint& point) const {
        return {point.query,
                among,
                point.profile,
                point.fitted,
                point.summary,
                evaluation(point.profile)};
    }
};

std::string choice_name(const image::SignatureKind& kind) {
    return std::string(image::color_space_name(kind.color_space)) + ", " +
           std::string(image::decomposition_name(kind.decomposition));
}

std::string weights_name(bool is_fitted) { return is_fitted ? "fitted" : "built-in"; }

Plot plot_of(const Figure45& figure,
             QueryKind query,
             image::BinRule rule,
             bool is_fitted) {
    Plot plot{query_kind_name(query) + ", " + std::string(image::bin_rule_name(rule)) +
                  ", " + weights_name(is_fitted) + " weights",
              {"coefficients per channel, m", 0, 100},
              {"% in the top 1 %", 0, 100},
              {}};
    double least = 80;
    for (const ChoicePoint& point : figure.points) {
        if (point.query != query || point.profile.bin_rule != rule ||
            point.fitted != is_fitted) {
            continue;
        }
        const std::string name = choice_name(point.profile.kind);
        if (plot.series.empty() || plot.series.back().name != name) {
            const int colour = static_cast<int>(point.profile.kind.color_space) - 1;
            const bool standard =
                point.profile.kind.decomposition == image::Decomposition::kStandard;
            plot.series.push_back({name, {colour, standard ? 0 : 1}, {}, true, false});
        }
        plot.series.back().points.push_back(
            rate_point(point.profile.m, point.summary.top_1_percent));
        // Easy queries crowd the top: the axis starts at a round value below them.
        const double share = 100 * point.summary.top_1_percent.share();
        least = std::min(least, 20 * std::floor(share / 20));
    }
    plot.y.low = least;
    return plot;
}

}  // namespace

const std::vector<image::SignatureKind>& all_kinds() {
    static const std::vector<image::SignatureKind> kinds = [] {
        std::vector<image::SignatureKind> all;
        for (const image::ColorSpace space : kSpaces) {
            for (const image::Decomposition decomposition : kDecompositions)
                all.push_back({space, decomposition});
        }
        return all;
    }();
    return kinds;
}

bool is_better(const ChoicePoint& a, const ChoicePoint& b) {
    const auto key = [](const ChoicePoint& point) {
        return std::tuple(point.summary.top_1_percent.hits,
                          point.summary.first.hits,
                          point.summary.mean_reciprocal,
                          -point.profile.m);
    };
    return key(a) > key(b);
}

Result<Figure45> measure_figure_4_5(const Experiment& experiment,
                                    const std::vector<int>& ms) {
    Searches searches;
    for (const image::SignatureKind& kind : all_kinds())
        searches[kind] = std::make_unique<WaveletSearch>(experiment.database(), kind);
    const bool fits = std::ssize(experiment.fitting()) >= image::kMinTrainingPairs;

    Figure45 figure;
    for (const QueryKind query : kQueries) {
        const bool scanned = query == QueryKind::kScanned;
        const Material material{*image::built_in_profile(scanned ? "scanned" : "painted"),
                                describe(experiment, query, experiment.fitting()),
                                describe(experiment, query, experiment.selection()),
                                describe(experiment, query, experiment.evaluation())};
        const Measured measured{experiment, searches, material};

        std::vector<ChoicePoint> built_in = combinations(query, material.base, ms);
        std::vector<ChoicePoint> with_fit = fits ? built_in : std::vector<ChoicePoint>{};
        std::vector<std::optional<Error>> failures(built_in.size());
        experiment.executor().parallel_for(built_in.size(), [&](std::size_t i) {
            built_in[i].summary = measured.selection(built_in[i].profile);
            if (!fits) return;
            Result<image::Profile> profile =
                fitted(experiment, material.fitting, built_in[i].profile);
            if (!profile) {
                failures[i] = profile.error();
                return;
            }
            with_fit[i].profile = std::move(*profile);
            with_fit[i].fitted = true;
            with_fit[i].summary = measured.selection(with_fit[i].profile);
        });
        for (const std::optional<Error>& failure : failures) {
            if (failure) return *failure;
        }

        const ChoicePoint unchanged{
            query, material.base, false, measured.selection(material.base)};
        figure.winners.push_back(measured.winner("the built-in profile", unchanged));
        const auto best = [](const std::vector<ChoicePoint>& points) {
            return *std::ranges::min_element(points, is_better);
        };
        figure.winners.push_back(measured.winner("built-in weights", best(built_in)));
        if (fits)
            figure.winners.push_back(measured.winner("fitted weights", best(with_fit)));
        std::ranges::move(built_in, std::back_inserter(figure.points));
        std::ranges::move(with_fit, std::back_inserter(figure.points));
    }
    return figure;
}

CsvTable to_csv(const Figure45& figure) {
    CsvTable table(with_rank_header({"query",
                                     "metric",
                                     "resolution",
                                     "color_space",
                                     "decomposition",
                                     "bin_rule",
                                     "weights",
                                     "m"}));
    for (const ChoicePoint& point : figure.points) {
        const MetricName name = wavelet_name(point.profile);
        table.add(with_ranks({query_kind_name(point.query),
                              name.metric,
                              name.resolution,
                              image::color_space_name(point.profile.kind.color_space),
                              image::decomposition_name(point.profile.kind.decomposition),
                              image::bin_rule_name(point.profile.bin_rule),
                              weights_name(point.fitted),
                              point.profile.m},
                             point.summary));
    }
    return table;
}

CsvTable winners_csv(const Figure45& figure) {
    CsvTable table(with_rank_header({"query",
                                     "metric",
                                     "resolution",
                                     "among",
                                     "color_space",
                                     "decomposition",
                                     "bin_rule",
                                     "weights",
                                     "m",
                                     "set"}));
    for (const Winner& winner : figure.winners) {
        const MetricName name = wavelet_name(winner.profile);
        for (const bool selection : {true, false}) {
            table.add(
                with_ranks({query_kind_name(winner.query),
                            name.metric,
                            name.resolution,
                            winner.among,
                            image::color_space_name(winner.profile.kind.color_space),
                            image::decomposition_name(winner.profile.kind.decomposition),
                            image::bin_rule_name(winner.profile.bin_rule),
                            weights_name(winner.fitted),
                            winner.profile.m,
                            selection ? "selection" : "evaluation"},
                           selection ? winner.selection : winner.evaluation));
        }
    }
    return table;
}

std::string to_html(const Figure45& figure) {
    const bool has_fitted = std::ranges::any_of(
        figure.points, [](const auto& point) { return point.fitted; });
    std::string html = paragraph(
        "Every combination on the queries of the selection set. With fitted weights each "
        "combination has weights of its own, found on the fitting set; with built-in "
        "weights all have those of the built-in profile for the kind of query, which "
        "were "
        "found for YIQ with the standard decomposition. HSV stands for S cos H, S sin H, "
        "V.");
    std::vector<Plot> plots;
    const auto panels_of = [&](image::BinRule rule) {
        std::vector<std::string> drawings;
        for (const bool is_fitted : {true, false}) {
            if (is_fitted && !has_fitted) continue;
            for (const QueryKind query : kQueries) {
                plots.push_back(plot_of(figure, query, rule, is_fitted));
                drawings.push_back(to_svg(plots.back()));
            }
        }
        return panels(drawings);
    };
    html += panels_of(image::BinRule::kLog2Plus1);
    html += legend(plots);
    html +=
        details("The other bin rules",
                panels_of(image::BinRule::kLinear) + panels_of(image::BinRule::kLiteral));
    return html;
}

std::string winners_html(const Figure45& figure) {
    HtmlTable table({"query",
                     "the best of",
                     "colour space",
                     "decomposition",
                     "bin rule",
                     "m",
                     "selection: top 1 %",
                     "evaluation: top 1 %",
                     "rank 1",
                     "mean reciprocal rank"},
                    5);
    for (const Winner& winner : figure.winners) {
        const image::Profile& profile = winner.profile;
        table.add({query_kind_name(winner.query),
                   winner.among,
                   std::string(image::color_space_name(profile.kind.color_space)),
                   std::string(image::decomposition_name(profile.kind.decomposition)),
                   std::string(image::bin_rule_name(profile.bin_rule)),
                   std::to_string(profile.m),
                   percent(winner.selection.top_1_percent),
                   percent_with_interval(winner.evaluation.top_1_percent),
                   percent_with_interval(winner.evaluation.first),
                   number(winner.evaluation.mean_reciprocal, 3)});
    }
    return paragraph(
               "For each kind of query: the built-in profile as it is, the best "
               "combination "
               "with its weights, and the best with fitted weights. Combinations are "
               "chosen "
               "on the selection queries (more in the top 1 %, then at rank 1, then the "
               "mean "
               "reciprocal rank, then fewer coefficients) and measured again on the "
               "evaluation queries, which took no part in the choice.") +
           table.html();
}

}  // namespace haarmony::eval
