// Cases with known answers about curves, as an independent program computed them, asked of a
// running daemon: those of the folder that HAARMONY_GOLDEN_CURVES names, whose README says
// what the members mean. A test without that variable is skipped.
//
// Scale   numbers agree within 1e-9 of the largest one of their kind in their case.
// Threads a fixture, one test at a time.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/e2e/collection.h"

namespace haarmony::e2e {

inline constexpr double kGoldenTolerance = 1e-9;

// All numbers of arrays within arrays, in their order; what is none is nan.
[[nodiscard]] std::vector<double> numbers_of(const nlohmann::json& value);

// The largest difference, in parts of the largest wanted number (at least 1); infinite where
// the shapes differ.
[[nodiscard]] double relative_error(const nlohmann::json& got,
                                    const nlohmann::json& want);

class GoldenCurves : public ::testing::Test {
  protected:
    void SetUp() override;

    // A file of the folder.
    nlohmann::json read(const std::string& file);
    // Control points of the curves of decompositions.json, by their names.
    std::map<std::string, nlohmann::json> curves();

    // The reply; what the daemon refuses is a complaint, and the reply an empty object.
    nlohmann::json ask(const std::string& target, const nlohmann::json& body);
    nlohmann::json points_at(const nlohmann::json& control, const nlohmann::json& u);

    // A case begins and ends; it has passed where nothing complained in between.
    void begin(const std::string& name);
    void equal(const nlohmann::json& got,
               const nlohmann::json& want,
               const std::string& what);
    void holds(bool condition, const std::string& what);
    void complain(const std::string& what);
    void end();

    // Passed out of all cases so far, and the largest error of those that passed.
    void print(const std::string& file) const;

  private:
    std::string folder_;
    std::optional<testing::TemporaryFolder> database_;
    std::optional<Daemon> daemon_;
    std::optional<testing::CurlClient> client_;
    std::string name_;  // of the case
    bool failed_ = false;
    double error_ = 0;  // its largest
    int cases_ = 0;
    int passed_ = 0;
    double worst_ = 0;
};

}  // namespace haarmony::e2e
