// The protocols one by one, on a few generated pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "server/app/thread_executor.h"
#include "tests/eval/database_size.h"
#include "tests/eval/figure_4_5.h"
#include "tests/eval/figure_4_6.h"
#include "tests/eval/figure_4_7.h"
#include "tests/eval/robustness.h"
#include "tests/eval/table_4_2.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

constexpr int kPictures = 40;
constexpr int kQueries = 4;

class Figures : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        static server::ThreadExecutor threads(1);
        static const PictureSource source = generated_pictures(kPictures);
        static const Database database =
            make_database(source, all_kinds(), threads).value();
        static const Experiment prepared =
            Experiment::prepare(source, database, 1, kQueries, threads).value();
        static const MetricPanel metrics(database);
        experiment_ = &prepared;
        panel_ = &metrics;
    }

    inline static const Experiment* experiment_ = nullptr;
    inline static const MetricPanel* panel_ = nullptr;
};

TEST_F(Figures, TheControlIsAtChance) {
    server::ThreadExecutor threads(1);
    const Experiment everything =
        Experiment::prepare(
            generated_pictures(kPictures), experiment_->database(), 1, kPictures, threads)
            .value();
    const Control control = measure_control(everything, *panel_);
    ASSERT_EQ(control.rows.size(), panel_->columns().size());
    EXPECT_DOUBLE_EQ(control.chance_top_20, 19.0 / 39);
    // A search that found these targets would have all of them in the top 20, six standard
    // errors above chance.
    const double error = std::sqrt(19.0 / 39 * 20 / 39 / kPictures);
    for (const RobustnessRow& row : control.rows) {
        EXPECT_NEAR(row.summary.top_20.share(), control.chance_top_20, 3 * error)
            << row.name.metric;
        // The query's own picture is closer, whatever the metric.
        EXPECT_EQ(row.summary.first.hits, 0) << row.name.metric;
    }
}

TEST_F(Figures, EveryDistortionHasARowForEachMetricAndOption) {
    const Robustness robustness = measure_robustness(*experiment_, *panel_);
    std::set<std::string> options;
    int identities = 0;
    for (const RobustnessRow& row : robustness.rows) {
        ASSERT_EQ(row.ranks.size(), std::size_t{kQueries});
        options.insert(row.option);
        if (row.distortion != "identity") continue;
        ++identities;
        EXPECT_EQ(row.summary.first.hits, kQueries) << row.name.metric << row.option;
    }
    EXPECT_EQ(identities, 7 + 3 * 2);  // metrics; options under two profiles
    EXPECT_TRUE(options.contains("orientations=all"));
    const auto turned = std::ranges::find_if(robustness.rows, [](const auto& row) {
        return row.distortion == "quarter turn" && row.option == "orientations=all";
    });
    ASSERT_NE(turned, robustness.rows.end());
    EXPECT_EQ(turned->summary.first.hits, kQueries);
}

TEST_F(Figures, Figure46HasEveryMetricForEachKindOfQuery) {
    const Figure46 figure = measure_figure_4_6(*experiment_, *panel_);
    ASSERT_EQ(figure.curves.size(), 3 * panel_->columns().size());
    for (const RankCurve& curve : figure.curves) {
        ASSERT_EQ(curve.ranks.size(), std::size_t{kQueries});
        for (const std::int64_t rank : curve.ranks) {
            EXPECT_GE(rank, 1);
            EXPECT_LE(rank, kPictures);
        }
    }
    EXPECT_EQ(figure.curves[0].name.metric, "L^q");
    EXPECT_GE(figure.curves[0].summary.first.hits,
              kQueries - 1);  // scans under "scanned"
}

TEST(CurvePlaces, RiseFromTheFirstPictureToAll) {
    for (const std::int64_t pictures : {1, 2, 20, 60, 900, 20558}) {
        const auto places = curve_places(pictures);
        EXPECT_EQ(places.front(), 1);
        EXPECT_EQ(places.back(), pictures);
        EXPECT_TRUE(std::ranges::is_sorted(places));
        EXPECT_EQ(std::ranges::adjacent_find(places), places.end()) << pictures;
        EXPECT_LE(places.size(), 20U + 12 * 10 + 1);  // ten doublings of 20 and the last
    }
}

TEST(Figure47, StartsUndistorted) {
    constexpr int kFew = 10;  // all of them are distorted
    server::ThreadExecutor threads(1);
    const PictureSource source = generated_pictures(kFew);
    const Database database =
        make_database(source, {image::SignatureKind{}}, threads).value();
    const Experiment experiment =
        Experiment::prepare(source, database, 1, 1, threads).value();
    const MetricPanel panel(database);
    const Figure47 figure = measure_figure_4_7(experiment, panel, 2);
    ASSERT_EQ(figure.points.size(), kEffects.size() * 2 * (panel.columns().size() + 2));
    for (const DistortionPoint& point : figure.points) {
        const double least = effect_value(point.effect, 0);
        EXPECT_GE(point.value, least);
        EXPECT_LE(point.value, effect_value(point.effect, 1));
        EXPECT_EQ(point.summary.first.trials, kFew);
        if (point.value == least && point.query == "target") {
            EXPECT_EQ(point.summary.first.hits, kFew) << effect_name(point.effect);
        }
    }
}

TEST(Distort, HasTheRangesOfTheDissertation) {
    EXPECT_EQ(effect_value(Effect::kScale, 0), 1);
    EXPECT_EQ(effect_value(Effect::kScale, 1), 2);
    EXPECT_EQ(effect_value(Effect::kRotation, 1), 45);
    EXPECT_EQ(effect_value(Effect::kTranslation, 1), 0.5);
    EXPECT_EQ(effect_value(Effect::kColourShift, 1), 1);
}

TEST(Distort, MovesInTheSameDirectionAtEveryStrength) {
    const RgbPicture grey = flat(8, 8, 128, 128, 128);
    Random weak(5);
    Random strong(5);
    const RgbPicture a = distort(grey, Effect::kColourShift, 0.1, weak);
    const RgbPicture b = distort(grey, Effect::kColourShift, 0.3, strong);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(3 * (a.rgb[c] - 128), b.rgb[c] - 128, 2.1);
}

TEST(Distort, AllFourAreOneAfterTheOther) {
    const RgbPicture picture = generated_picture(6);
    Random once(5);
    Random step_by_step(5);
    RgbPicture expected = picture;
    for (const Effect effect : {Effect::kScale,
                                Effect::kRotation,
                                Effect::kTranslation,
                                Effect::kColourShift}) {
        expected = distort(expected, effect, 0.4, step_by_step);
    }
    EXPECT_EQ(distort(picture, Effect::kAll, 0.4, once).rgb, expected.rgb);
}

TEST_F(Figures, NestedDatabasesGiveTheRanksOfDatabasesOfTheirOwn) {
    const DatabaseSize measured = measure_database_size(*experiment_, *panel_);
    const auto sizes = nested_sizes(kQueries, kPictures);
    ASSERT_EQ(measured.points.size(), 2 * sizes.size());
    const SizePoint& all = measured.points[sizes.size() - 1];
    std::vector<std::int64_t> ranks;
    for (const std::size_t target : experiment_->evaluation()) {
        ranks.push_back(panel_->ranks(
            experiment_->query(QueryKind::kScanned, target).view(), target)[0]);
    }
    const RankSummary expected = summarize(ranks, kPictures);
    EXPECT_EQ(all.summary.first.hits, expected.first.hits);
    EXPECT_EQ(all.summary.mean_reciprocal, expected.mean_reciprocal);

    // The smallest database is the targets alone; an index of nothing else must agree.
    Database targets;
    for (const std::size_t place : experiment_->evaluation()) {
        targets.names.push_back(experiment_->database().names[place]);
        for (const auto& [kind, signatures] : experiment_->database().signatures)
            targets.signatures[kind].push_back(signatures[place]);
    }
    const WaveletSearch search(targets, image::SignatureKind{});
    ranks.clear();
    for (std::size_t i = 0; i < targets.names.size(); ++i) {
        const QueryPicture query =
            experiment_->query(QueryKind::kPainted, experiment_->evaluation()[i]);
        ranks.push_back(search.rank(
            image::make_signature(query.view()), *image::built_in_profile("painted"), i));
    }
    const SizePoint& smallest = measured.points[sizes.size()];
    EXPECT_EQ(smallest.summary.pictures, kQueries);
    EXPECT_EQ(smallest.summary.mean_reciprocal,
              summarize(ranks, kQueries).mean_reciprocal);
}

TEST(NestedSizes, AreTwentyRisingOnesOrAllThereAre) {
    const auto sizes = nested_sizes(150, 900);
    EXPECT_EQ(sizes.size(), 20U);
    EXPECT_EQ(sizes.front(), 150);
    EXPECT_EQ(sizes.back(), 900);
    EXPECT_EQ(nested_sizes(5, 8), (std::vector<std::int64_t>{5, 6, 7, 8}));
    EXPECT_EQ(nested_sizes(4, 4), (std::vector<std::int64_t>{4}));
}

TEST_F(Figures, Table42HasEveryMetricAtBothSizes) {
    const Table42 table = measure_table_4_2(*experiment_, 40, 100);
    ASSERT_EQ(table.rows.size(), 2 * (1 + kRivals.size()));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        EXPECT_EQ(table.rows[i].pictures, i < table.rows.size() / 2 ? 40 : 100);
        EXPECT_EQ(table.rows[i].queries, kQueries);
        EXPECT_GT(table.rows[i].median_ms, 0);
    }
    EXPECT_EQ(table.rows[0].name, (MetricName{"L^q", "m=20"}));
}

TEST(TimedSizes, AreTheFolderAndAMultipleOrATenth) {
    EXPECT_EQ(timed_sizes(900), (std::pair<std::int64_t, std::int64_t>{900, 9000}));
    EXPECT_EQ(timed_sizes(4000), (std::pair<std::int64_t, std::int64_t>{4000, 8000}));
    EXPECT_EQ(timed_sizes(20000), (std::pair<std::int64_t, std::int64_t>{2000, 20000}));
}

TEST_F(Figures, Figure45ComparesEveryCombinationWithBothWeights) {
    const auto figure = measure_figure_4_5(*experiment_, {20});
    ASSERT_TRUE(figure) << figure.error().message;
    // Three kinds of query, ten kinds of signature, three bin rules, two sets of weights.
    EXPECT_EQ(figure->points.size(), 3U * 10 * 3 * 2);
    ASSERT_EQ(figure->winners.size(), 9U);
    for (const Winner& winner : figure->winners) {
        EXPECT_EQ(winner.evaluation.first.trials, kQueries);
        if (winner.among == "the built-in profile") continue;
        for (const ChoicePoint& point : figure->points) {
            if (point.query != winner.query || point.fitted != winner.fitted) continue;
            EXPECT_GE(winner.selection.top_1_percent.hits,
                      point.summary.top_1_percent.hits);
        }
    }
}

TEST(IsBetter, LooksAtTheTopFirstAndAtTheCostLast) {
    ChoicePoint a;
    ChoicePoint b;
    a.summary.top_1_percent.hits = 2;
    b.summary.top_1_percent.hits = 1;
    b.summary.first.hits = 1;
    EXPECT_TRUE(is_better(a, b));
    b.summary.top_1_percent.hits = 2;
    EXPECT_TRUE(is_better(b, a));
    a.summary.first.hits = 1;
    EXPECT_FALSE(is_better(a, b));
    EXPECT_FALSE(is_better(b, a));
    a.profile.m = 40;
    EXPECT_TRUE(is_better(a, b));
    b.summary.mean_reciprocal = 0.1;
    EXPECT_TRUE(is_better(b, a));
}

}  // namespace
}  // namespace haarmony::eval
