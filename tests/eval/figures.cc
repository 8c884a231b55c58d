#include "tests/eval/figures.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/eval/database.h"
#include "tests/eval/database_size.h"
#include "tests/eval/experiment.h"
#include "tests/eval/figure_4_6.h"
#include "tests/eval/figure_4_7.h"
#include "tests/eval/ranking.h"
#include "tests/eval/robustness.h"
#include "tests/eval/table_4_2.h"

namespace haarmony::eval {

Result<std::vector<OutputFile>> make_figures(
    const PictureSource& source,
    const FiguresOptions& options,
    Executor& executor,
    const std::function<void(const std::string&)>& progress) {
    progress("reading " + std::to_string(source.names.size()) + " files");
    const Result<Database> database =
        make_database(source, {image::SignatureKind{}}, executor);
    if (!database) return database.error();
    const Result<Experiment> experiment =
        Experiment::prepare(source, *database, options.seed, options.queries, executor);
    if (!experiment) return experiment.error();
    const MetricPanel panel(*database);

    std::vector<OutputFile> files;
    const auto add = [&](const std::string& name, const CsvTable& table) {
        files.push_back({name, table.text()});
    };
    progress("Figure 4.6");
    const Figure46 figure_4_6 = measure_figure_4_6(*experiment, panel);
    add("figure_4_6.csv", to_csv(figure_4_6));
    add("figure_4_6_ranks.csv", summary_csv(figure_4_6));
    progress("robustness");
    const Robustness robustness = measure_robustness(*experiment, panel);
    add("robustness.csv", to_csv(robustness.rows));
    progress("control");
    const Control control = measure_control(*experiment, panel);
    add("control.csv", to_csv(control.rows));
    progress("Figure 4.7");
    const Figure47 figure_4_7 = measure_figure_4_7(*experiment, panel, options.steps);
    add("figure_4_7.csv", to_csv(figure_4_7));
    progress("section 4.5.4");
    const DatabaseSize size = measure_database_size(*experiment, panel);
    add("database_size.csv", to_csv(size));
    progress("Table 4.2");
    const auto [small, large] = timed_sizes(database->size());
    const Table42 table_4_2 = measure_table_4_2(*experiment, small, large);
    add("table_4_2.csv", to_csv(table_4_2));
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
