#include "tests/eval/train_profile.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "server/api/profile_json.h"
#include "server/api/training_pair_json.h"
#include "server/app/connection.h"
#include "server/app/profile_training.h"

namespace haarmony::eval {
namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    std::array<char, 256> line{};
    const int length = std::snprintf(line.data(), line.size(), format, values...);
    return {line.data(), static_cast<std::size_t>(length)};
}

struct PairsFile {
    std::vector<server::QueryPair> pairs;
    std::vector<int> lines;  // of each pair
};

// Each bad line is named on `err`, and then there are no pairs.
std::optional<PairsFile> read_pairs(const TrainProfileOptions& options,
                                    std::ostream& err) {
    std::ifstream file(options.pairs);
    if (!file) {
        err << options.pairs << ": cannot be read\n";
        return {};
    }
    PairsFile read_file;
    bool all_good = true;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        auto read = server::parse_pair(line);
        if (!read) {
            err << options.pairs << ':' << number << ": " << read.problem().detail
                << '\n';
            all_good = false;
        } else if (options.kind.empty() || read->feedback.kind == options.kind) {
            read_file.pairs.push_back(std::move(read->pair));
            read_file.lines.push_back(number);
        }
    }
    if (file.bad()) {
        err << options.pairs << ": cannot be read to its end\n";
        return {};
    }
    if (!all_good) return {};
    return read_file;
}

std::string rank_line(const char* name, const image::RankSummary& summary) {
    return formatted("  %-9s %8.1f %8.1f %7.1f%% %7.1f%% %7.1f%% %8.4f\n",
                     name,
                     summary.median,
                     summary.mean,
                     100 * summary.first,
                     100 * summary.top_20,
                     100 * summary.top_percent,
                     summary.mean_reciprocal_rank);
}

std::string report_text(const server::ProfileFit& fit, const std::string& base) {
    const image::TrainingReport& report = fit.report;
    std::string text = formatted(
        "%d pairs and %d mismatches fitted in %d iterations%s\n"
        "log-likelihood %.3f, without features %.3f\n"
        "weights (* would be negative)\n",
        report.fitted_pairs,
        report.mismatches,
        report.iterations,
        report.converged ? "" : ", which did not suffice",
        report.log_likelihood,
        report.null_log_likelihood);
    for (std::size_t channel = 0; channel < report.profile.weights.size(); ++channel) {
        text += ' ';
        for (std::size_t bin = 0; bin < report.profile.weights[channel].size(); ++bin)
            text += formatted(" %9.2f%c",
                              report.profile.weights[channel][bin] / 100.0,
                              report.clamped[channel][bin] ? '*' : ' ');
        text += '\n';
    }
    text += formatted(
        "ranks of %zu pairs that were held back, among %lld pictures\n"
        "              median     mean   rank 1  top 20   top 1%%     MRR\n",
        report.held_back.pairs.size(),
        static_cast<long long>(report.held_back.candidates));
    text += rank_line("before", report.held_back.before_summary);
    if (fit.existing) text += rank_line("existing", *fit.existing);
    text += rank_line("after", report.held_back.after_summary);
    text += "before: the profile " + base + "\n";
    return text;
}

// "pairs.jsonl:7" where the complaint is about the pair of that line.
std::string place_of(const Error& error,
                     const PairsFile& file,
                     const TrainProfileOptions& options) {
    for (std::size_t i = 0; i < file.lines.size(); ++i)
        if (error.param == "pairs[" + std::to_string(i) + "]")
            return options.pairs + ":" + std::to_string(file.lines[i]);
    return "cannot train";
}

int failed(const std::string& what, const Error& error, std::ostream& err) {
    err << what << ": " << error.message << '\n';
    return kExitFailed;
}

}  // namespace

int train_profile(const TrainProfileOptions& options,
                  std::ostream& out,
                  std::ostream& err) {
    if (const auto problem = server::refuse_name(options.profile)) {
        err << problem->detail << '\n';
        return kExitUsage;
    }
    const auto file = read_pairs(options, err);
    if (!file) return kExitFailed;
    // Opening would make one.
    std::error_code unknown;
    if (!std::filesystem::exists(options.database, unknown)) {
        err << options.database << ": there is no such database\n";
        return kExitFailed;
    }
    auto connection = server::Connection::open(options.database,
                                               schema::Database::Mode::kReadWriteCreate);
    if (!connection) return failed("cannot train", connection.error(), err);

    server::ProfileFitOptions training;
    training.name = options.profile;
    training.base = options.base;
    training.replace_worse = options.replace_worse;
    training.seed = options.seed;
    const auto fit = server::fit_profile(**connection, file->pairs, training);
    if (!fit) return failed(place_of(fit.error(), *file, options), fit.error(), err);
    out << report_text(fit.value(), options.base);
    const auto stored = server::store_fit(**connection, fit.value(), training);
    if (!stored) return failed("cannot store", stored.error(), err);
    if (*stored) {
        out << "stored as " << options.profile << '\n';
        return kExitStored;
    }
    out << "not stored: " << options.profile
        << " is there and would get worse (--replace-worse stores it all the same)\n";
    return kExitWorse;
}

}  // namespace haarmony::eval
