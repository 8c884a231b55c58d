#include "tests/eval/figure_4_7.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tests/eval/affine.h"
#include "tests/eval/distortions.h"
#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/rank_table.h"
#include "tests/eval/recolour.h"

namespace haarmony::eval {
namespace {

using Ranks = std::vector<std::int64_t>;

struct Column {
    std::string query;
    MetricName name;
    std::string profile;
};

// The curves of the figure: every metric on the targets themselves, and the profile that is
// meant for it on each kind of simulated query.
std::vector<Column> columns_of(const MetricPanel& panel) {
    std::vector<Column> columns;
    for (const auto& [name, profile] : panel.columns())
        columns.push_back({"target", name, profile});
    for (const image::Profile& profile : panel.profiles())
        columns.push_back({profile.name, wavelet_name(profile), profile.name});
    return columns;
}

// The simulated queries for one picture, one a profile of the panel.
struct Originals {
    std::vector<RgbPicture> queries;
};

Originals originals_of(const Experiment& experiment,
                       const MetricPanel& panel,
                       std::size_t target) {
    Originals originals;
    for (const image::Profile& profile : panel.profiles()) {
        Random random = experiment.random(profile.name, target);
        const RgbPicture& picture = experiment.picture(target);
        originals.queries.push_back(profile.name == "scanned"
                                        ? simulate_scan(picture, random)
                                        : simulate_painting(picture, random));
    }
    return originals;
}

// The target's rank in each column.
Ranks ranks_at(const Experiment& experiment,
               const MetricPanel& panel,
               const Originals& originals,
               Effect effect,
               double strength,
               std::size_t target) {
    const auto distorted = [&](const RgbPicture& picture) {
        Random random = experiment.random(effect_name(effect), target);
        return distort(picture, effect, strength, random);
    };
    Ranks ranks = panel.ranks(distorted(experiment.picture(target)).view(), target);
    for (std::size_t i = 0; i < panel.profiles().size(); ++i) {
        const RgbPicture query = distorted(originals.queries[i]);
        ranks.push_back(panel.search().rank(
            image::make_signature(query.view()), panel.profiles()[i], target));
    }
    return ranks;
}

}  // namespace

std::string effect_name(Effect effect) {
    switch (effect) {
        case Effect::kScale:
            return "scale";
        case Effect::kRotation:
            return "rotation";
        case Effect::kTranslation:
            return "translation";
        case Effect::kColourShift:
            return "colour shift";
        case Effect::kAll:
            break;
    }
    return "all four";
}

std::string axis_label(Effect effect) {
    switch (effect) {
        case Effect::kScale:
            return "scale factor";
        case Effect::kRotation:
            return "rotation, degrees";
        case Effect::kTranslation:
            return "translation, widths";
        case Effect::kColourShift:
            return "colour shift, of the cube's side";
        case Effect::kAll:
            break;
    }
    return "share of the most of each";
}

double effect_value(Effect effect, double strength) {
    switch (effect) {
        case Effect::kScale:
            return 1 + strength;
        case Effect::kRotation:
            return 45 * strength;
        case Effect::kTranslation:
            return 0.5 * strength;
        case Effect::kColourShift:
        case Effect::kAll:
            break;
    }
    return strength;
}

RgbPicture distort(const RgbPicture& picture,
                   Effect effect,
                   double strength,
                   Random& random) {
    assert(strength >= 0 && strength <= 1);
    const auto value = [&](Effect part) { return effect_value(part, strength); };
    switch (effect) {
        case Effect::kScale:
            return enlarge(picture, value(Effect::kScale));
        case Effect::kRotation:
            return rotate(picture, random.sign() * value(Effect::kRotation));
        case Effect::kTranslation:
            return random_translation(picture, value(Effect::kTranslation), random);
        case Effect::kColourShift:
            return random_colour_shift(picture, value(Effect::kColourShift), random);
        case Effect::kAll:
            break;
    }
    RgbPicture result = picture;
    for (const Effect part : kEffects) {
        if (part != Effect::kAll) result = distort(result, part, strength, random);
    }
    return result;
}

Figure47 measure_figure_4_7(const Experiment& experiment,
                            const MetricPanel& panel,
                            int steps) {
    assert(steps >= 2);
    Figure47 figure;
    const std::vector<Column> columns = columns_of(panel);
    const std::vector<std::size_t>& targets = experiment.distorted();
    std::vector<Originals> originals(targets.size());
    experiment.executor().parallel_for(targets.size(), [&](std::size_t i) {
        originals[i] = originals_of(experiment, panel, targets[i]);
    });
    for (const Effect effect : kEffects) {
        for (int step = 0; step < steps; ++step) {
            const double strength = static_cast<double>(step) / (steps - 1);
            std::vector<Ranks> by_query(targets.size());
            experiment.executor().parallel_for(targets.size(), [&](std::size_t i) {
                by_query[i] = ranks_at(
                    experiment, panel, originals[i], effect, strength, targets[i]);
            });
            for (std::size_t c = 0; c < columns.size(); ++c) {
                Ranks ranks;
                for (const Ranks& all : by_query) ranks.push_back(all[c]);
                figure.points.push_back({effect,
                                         effect_value(effect, strength),
                                         columns[c].query,
                                         columns[c].name,
                                         columns[c].profile,
                                         summarize(ranks, experiment.database().size())});
            }
        }
    }
    return figure;
}

CsvTable to_csv(const Figure47& figure) {
    CsvTable table(with_rank_header(
        {"effect", "strength", "query", "metric", "resolution", "profile"}));
    for (const DistortionPoint& point : figure.points) {
        table.add(with_ranks({effect_name(point.effect),
                              point.value,
                              point.query,
                              point.name.metric,
                              point.name.resolution,
                              point.profile},
                             point.summary));
    }
    return table;
}

std::string to_html(const Figure47& figure) {
    const auto plot_of = [&](Effect effect, bool of_targets) {
        Plot plot{effect_name(effect),
                  {axis_label(effect), effect_value(effect, 0), effect_value(effect, 1)},
                  {"% in the top 1 %", 0, 100},
                  {}};
        for (const DistortionPoint& point : figure.points) {
            if (point.effect != effect || (point.query == "target") != of_targets)
                continue;
            const std::string name =
                of_targets
                    ? metric_label(point.name, point.profile)
                    : point.query + " query, " + metric_label(point.name, point.profile);
            auto series = std::ranges::find(plot.series, name, &PlotSeries::name);
            if (series == plot.series.end()) {
                plot.series.push_back({name,
                                       metric_style(point.name, point.profile),
                                       {},
                                       true,
                                       !of_targets});
                series = plot.series.end() - 1;
            }
            series->points.push_back(
                rate_point(point.value, point.summary.top_1_percent));
        }
        return plot;
    };
    std::string html = paragraph(
        "The percentage of queries whose target is in the top 1 % of the database, as "
        "the "
        "distortion grows. Upper row: the targets themselves are distorted, under every "
        "metric. Lower row: simulated scanned and painted queries are distorted, under "
        "L^q "
        "with the profile that is meant for them; the bands are 95 % intervals.");
    for (const bool of_targets : {true, false}) {
        std::vector<Plot> plots;
        std::vector<std::string> drawings;
        for (const Effect effect : kEffects) plots.push_back(plot_of(effect, of_targets));
        for (const Plot& plot : plots) drawings.push_back(to_svg(plot));
        html += panels(drawings) + legend(plots);
    }
    return html;
}

}  // namespace haarmony::eval
