#include "tests/eval/figures.h"

#include <filesystem>
#include <fstream>
#include <utility>

#include "tests/eval/database.h"
#include "tests/eval/database_size.h"
#include "tests/eval/experiment.h"
#include "tests/eval/figure_4_5.h"
#include "tests/eval/figure_4_6.h"
#include "tests/eval/figure_4_7.h"
#include "tests/eval/page.h"
#include "tests/eval/ranking.h"
#include "tests/eval/robustness.h"
#include "tests/eval/table_4_2.h"

namespace haarmony::eval {
namespace {

std::string introduction(const Experiment& experiment, const FiguresOptions& options) {
    const Database& database = experiment.database();
    std::string html = paragraph(
        std::to_string(database.size()) + " pictures, " +
        std::to_string(experiment.evaluation().size()) + " queries, " +
        std::to_string(experiment.distorted().size()) +
        " pictures in the tests of Figure 4.7, seed " + std::to_string(options.seed) +
        ". A rank counts the pictures that are strictly closer, and the equally close "
        "ones "
        "that were added earlier. Intervals are 95 %: Wilson's for rates, the "
        "bootstrap's "
        "for means.");
    html += paragraph(
        "Scanned and painted queries are simulated: a scan is small, dark, noisy, "
        "slightly "
        "turned and moved; a painting is 8 x 8 to 16 x 16 flat squares of vivid colours "
        "that "
        "are a little off. Both are stand-ins; real hands err in other ways, and figures "
        "of "
        "100 % mean that no failure was seen here.");
    if (experiment.training_overlaps()) {
        html += paragraph(
            "There are too few pictures to keep those that the metric was trained with "
            "out "
            "of the evaluation.");
    }
    if (!database.unreadable.empty()) {
        html += paragraph(std::to_string(database.unreadable.size()) +
                          " files are no pictures that can be read.");
    }
    return html;
}

}  // namespace

Result<std::vector<OutputFile>> make_figures(
    const PictureSource& source,
    const FiguresOptions& options,
    Executor& executor,
    const std::function<void(const std::string&)>& progress) {
    progress("reading " + std::to_string(source.names.size()) + " files");
    const Result<Database> database = make_database(source, all_kinds(), executor);
    if (!database) return database.error();
    if (database->size() < 2) {
        return Error{ErrorCode::kInvalidArgument,
                     database->names.front() + " is the only picture; two are the least"};
    }
    const Result<Experiment> experiment =
        Experiment::prepare(source, *database, options.seed, options.queries, executor);
    if (!experiment) return experiment.error();
    const MetricPanel panel(*database);

    std::vector<OutputFile> files;
    std::vector<Section> sections;
    const auto show = [&](const char* anchor, const char* title, std::string html) {
        sections.push_back({anchor, title, std::move(html)});
    };
    const auto add = [&](const std::string& name, const CsvTable& table) {
        files.push_back({name, table.text()});
    };
    progress("Figure 4.5");
    std::vector<int> ms;
    for (int m = options.m_step; m <= image::kMaxCoefficients; m += options.m_step)
        ms.push_back(m);
    const Result<Figure45> figure_4_5 = measure_figure_4_5(*experiment, ms);
    if (!figure_4_5) return figure_4_5.error();
    show("figure-4-5",
         "Figure 4.5: colour space, decomposition and number of coefficients",
         to_html(*figure_4_5));
    add("figure_4_5.csv", to_csv(*figure_4_5));
    add("winners.csv", winners_csv(*figure_4_5));
    progress("Figure 4.6");
    const Figure46 figure_4_6 = measure_figure_4_6(*experiment, panel);
    show("figure-4-6", "Figure 4.6: L^q, L1, L2 and the histogram", to_html(figure_4_6));
    add("figure_4_6.csv", to_csv(figure_4_6));
    add("figure_4_6_ranks.csv", summary_csv(figure_4_6));
    progress("robustness");
    const Robustness robustness = measure_robustness(*experiment, panel);
    show("robustness", "Robustness: what happens to copies", to_html(robustness));
    add("robustness.csv", to_csv(robustness.rows));
    progress("control");
    const Control control = measure_control(*experiment, panel);
    show("control", "Control: targets exchanged", to_html(control));
    add("control.csv", to_csv(control.rows));
    progress("Figure 4.7");
    const Figure47 figure_4_7 = measure_figure_4_7(*experiment, panel, options.steps);
    show("figure-4-7", "Figure 4.7: distortions that grow", to_html(figure_4_7));
    add("figure_4_7.csv", to_csv(figure_4_7));
    progress("section 4.5.4");
    const DatabaseSize size = measure_database_size(*experiment, panel);
    show("database-size", "Section 4.5.4: the size of the database", to_html(size));
    add("database_size.csv", to_csv(size));
    progress("Table 4.2");
    const auto [small, large] = timed_sizes(database->size());
    const Table42 table_4_2 = measure_table_4_2(*experiment, small, large);
    show("table-4-2", "Table 4.2: the time of a query", to_html(table_4_2));
    add("table_4_2.csv", to_csv(table_4_2));
    show("winners", "Which combination wins", winners_html(*figure_4_5));
    files.insert(files.begin(),
                 {"index.html",
                  page("Searching by pictures: the evaluation",
                       introduction(*experiment, options),
                       sections)});
    return files;
}

Result<void> write_files(const std::vector<OutputFile>& files,
                         const std::string& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) return Error{ErrorCode::kIo, folder + ": " + failure.message()};
    for (const OutputFile& file : files) {
        const std::string path = (std::filesystem::path(folder) / file.name).string();
        std::ofstream out(path, std::ios::binary);
        out << file.text;
        if (!out.flush()) return Error{ErrorCode::kIo, path + ": cannot be written"};
    }
    return {};
}

}  // namespace haarmony::eval
