#include "tests/e2e/golden_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace haarmony::e2e {
namespace {

using nlohmann::json;

void append_numbers(const json& value, std::vector<double>& numbers) {
    if (value.is_array()) {
        for (const json& child : value) append_numbers(child, numbers);
    } else {
        numbers.push_back(value.is_number() ? value.get<double>() : std::nan(""));
    }
}

}  // namespace

std::vector<double> numbers_of(const json& value) {
    std::vector<double> numbers;
    append_numbers(value, numbers);
    return numbers;
}

double relative_error(const json& got, const json& want) {
    const std::vector<double> a = numbers_of(got);
    const std::vector<double> b = numbers_of(want);
    double size = 1;
    for (const double number : b) size = std::max(size, std::abs(number));
    constexpr double kAnother = std::numeric_limits<double>::infinity();
    if (a.size() != b.size()) return kAnother;
    double error = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = std::abs(a[i] - b[i]) / size;
        error = std::max(error, std::isnan(difference) ? kAnother : difference);
    }
    return error;
}

void GoldenCurves::SetUp() {
    const char* folder = std::getenv("HAARMONY_GOLDEN_CURVES");
    if (folder == nullptr)
        GTEST_SKIP() << "HAARMONY_GOLDEN_CURVES names no folder of golden curves";
    folder_ = folder;
    database_.emplace();
    daemon_.emplace(database_->file("haarmony.db"),
                    std::vector<std::string>{"--log-level", "warn"});
    client_.emplace(daemon_->url());
}

json GoldenCurves::read(const std::string& file) {
    std::ifstream stream(folder_ + "/" + file);
    json read = json::parse(stream, nullptr, false);
    if (read.is_discarded()) throw std::runtime_error("no JSON: " + folder_ + "/" + file);
    return read;
}

std::map<std::string, json> GoldenCurves::curves() {
    std::map<std::string, json> found;
    const json all = read("decompositions.json");
    for (const json& curve : all.at("curves"))
        found[curve.at("name")] = curve.at("control");
    return found;
}

json GoldenCurves::ask(const std::string& target, const json& body) {
    const auto reply = client_->post(target, body.dump(), "application/json");
    if (reply.status == 200) return json::parse(reply.body);
    complain(target + ": " + reply.body);
    return json::object();
}

json GoldenCurves::points_at(const json& control, const json& u) {
    return ask("/curve/evaluate", {{"points", control}, {"u", u}})
        .value("points", json());
}

void GoldenCurves::begin(const std::string& name) {
    name_ = name;
    failed_ = false;
    error_ = 0;
    ++cases_;
}

void GoldenCurves::equal(const json& got, const json& want, const std::string& what) {
    const double error = relative_error(got, want);
    error_ = std::max(error_, error);
    if (!(error <= kGoldenTolerance)) complain(what + " is off by " + json(error).dump());
}

void GoldenCurves::holds(bool condition, const std::string& what) {
    if (!condition) complain(what + " does not hold");
}

void GoldenCurves::complain(const std::string& what) {
    failed_ = true;
    ADD_FAILURE() << name_ << ": " << what;
}

void GoldenCurves::end() {
    if (failed_) return;
    ++passed_;
    worst_ = std::max(worst_, error_);
}

void GoldenCurves::print(const std::string& file) const {
    std::cout << "golden " << file << ": " << passed_ << " of " << cases_
              << " passed, worst relative error " << worst_ << '\n';
}

}  // namespace haarmony::e2e
