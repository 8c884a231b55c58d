// haarmony-eval train: the file, the exit codes, and what a running service sees of it.
#include "tests/eval/train_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "engine/image/signature_codec.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"
#include "tests/support/process.h"

namespace haarmony::eval {
namespace {

constexpr int kPictures = 24;
constexpr const char* kDrawing =
    R"({"width":40,"height":30,"background":"#20a0f0","items":[{"points":[[1,2],[30,20]],"width":8,)"
    R"("color":"#c04020"}]})";

class TrainProfileTest : public ::testing::Test {
  protected:
    TrainProfileTest() {
        collection_.open();
        for (int number = 1; number <= kPictures; ++number) {
            const ImageId id = collection_.add(static_cast<unsigned>(number));
            signatures_.push_back(
                image::signature_to_text(*collection_.service->signature(id)));
        }
        options_.database = collection_.path();
        options_.pairs = collection_.folder.file("pairs.jsonl");
        options_.profile = "mine";
    }

    // Every second picture is remembered as it is, the others as those `shift` ids on.
    [[nodiscard]] std::vector<std::string> lines(int shift = 0) const {
        std::vector<std::string> all;
        for (int i = 0; i < kPictures; ++i)
            all.push_back(
                R"({"signature":")" + signatures_[(i + i % 2 * shift) % kPictures] +
                R"(","target":)" + std::to_string(i + 1) + R"(,"kind":"painted"})");
        return all;
    }
    void write(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        schema::write_bytes(options_.pairs, text);
    }
    int train() {
        out_.str("");
        err_.str("");
        return train_profile(options_, out_, err_);
    }
    bool said(const std::string& text) const {
        return out_.str().find(text) != std::string::npos;
    }
    bool complained(const std::string& text) const {
        return err_.str().find(text) != std::string::npos;
    }

    server::Collection collection_;
    std::vector<std::string> signatures_;
    TrainProfileOptions options_;
    std::ostringstream out_;
    std::ostringstream err_;
};

TEST_F(TrainProfileTest, ARunningServiceUsesTheProfileAtOnce) {
    write(lines());
    EXPECT_FALSE(collection_.service->profile("mine"));
    ASSERT_EQ(train(), kExitStored) << err_.str();
    const auto profile = collection_.service->profile("mine");
    ASSERT_TRUE(profile);
    EXPECT_TRUE(profile->calibration);
    EXPECT_NE(profile->weights, image::built_in_profile("painted")->weights);
    EXPECT_TRUE(said("12 pairs and 276 mismatches"));
    EXPECT_TRUE(said("ranks of 12 pairs that were held back, among 25 pictures"));
    EXPECT_TRUE(said("stored as mine"));
    EXPECT_EQ(err_.str(), "");
}

TEST_F(TrainProfileTest, ReadsEveryFormOfAPair) {
    std::vector<std::string> all = lines();
    all[3] = std::string(R"({"strokes":)") + kDrawing + R"(,"target":4})";
    all[5] = R"({"signature":{"average":[0.5,0,0],"coefficients":[[-1,128],[2],[]]},)"
             R"("target":6,"seconds":2.5})";
    all[7] += "\r";
    all.insert(all.begin() + 9, " \t");
    write(all);
    EXPECT_EQ(train(), kExitStored) << err_.str();
    EXPECT_TRUE(said("12 pairs"));
}

TEST_F(TrainProfileTest, EachBadLineIsNamedByItsNumber) {
    std::vector<std::string> all = lines();
    all[1] = "{";
    all[4] = R"({"signature":"no","target":1})";
    all[6] = R"({"target":1})";
    all[8] = "[]";
    all[10] = std::string(R"({"strokes":)") + kDrawing + R"(,"target":1,"sort":"x"})";
    write(all);
    EXPECT_EQ(train(), kExitFailed);
    for (const char* place : {"pairs.jsonl:2: malformed JSON",
                              "pairs.jsonl:5: signature: ",
                              "pairs.jsonl:7: nothing to learn from",
                              "pairs.jsonl:9: the JSON body must be an object",
                              "pairs.jsonl:11: 'sort' is not known here"})
        EXPECT_TRUE(complained(place)) << place << "\n" << err_.str();
    std::string complaints = err_.str();
    EXPECT_EQ(std::count(complaints.begin(), complaints.end(), '\n'), 5);
    EXPECT_FALSE(collection_.service->profile("mine"));
}

TEST_F(TrainProfileTest, APairThatCannotBeLearnedFromIsNamedByItsLine) {
    std::vector<std::string> all = lines();
    all.insert(all.begin() + 2, "");
    all[6] = R"({"signature":")" + signatures_[0] + R"(","target":99})";
    write(all);
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("pairs.jsonl:7: ")) << err_.str();
    EXPECT_TRUE(complained("99"));
}

TEST_F(TrainProfileTest, TakesOnlyPairsOfTheKind) {
    std::vector<std::string> all = lines();
    for (int i = 0; i < 3; ++i)
        all.push_back(R"({"signature":")" + signatures_[0] +
                      R"(","target":1,"kind":"scanned"})");
    write(all);
    options_.kind = "painted";
    EXPECT_EQ(train(), kExitStored) << err_.str();
    EXPECT_TRUE(said("12 pairs and"));
    options_.kind = "scanned";
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("3 pairs: at least 20 are needed"));
}

TEST_F(TrainProfileTest, AWorseProfileIsNotStoredUnasked) {
    write(lines());
    ASSERT_EQ(train(), kExitStored);
    write(lines(7));
    int kept = 0;
    for (options_.seed = 0; options_.seed < 20 && kept == 0; ++options_.seed) {
        const auto before = collection_.service->profile("mine")->weights;
        const int code = train();
        if (code == kExitStored) continue;
        ASSERT_EQ(code, kExitWorse) << err_.str();
        EXPECT_TRUE(said("not stored: mine"));
        EXPECT_TRUE(said("existing"));
        EXPECT_EQ(collection_.service->profile("mine")->weights, before);
        options_.replace_worse = true;
        EXPECT_EQ(train(), kExitStored);
        EXPECT_NE(collection_.service->profile("mine")->weights, before);
        ++kept;
    }
    EXPECT_EQ(kept, 1);
}

TEST_F(TrainProfileTest, WhatCannotRunSaysWhy) {
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("pairs.jsonl: cannot be read"));
    write(lines());
    options_.base = "nobody";
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("there is no profile 'nobody'"));
    options_.base = "painted";
    options_.profile = "scanned";
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("built in"));
    options_.profile = "My profile";
    EXPECT_EQ(train(), kExitUsage);
    EXPECT_TRUE(complained("'My profile'"));
    options_.profile = "mine";
    options_.database = collection_.folder.file("absent.db");
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("absent.db: there is no such database"));
    EXPECT_FALSE(schema::files_of(collection_.folder).contains("absent.db"));
    options_.database = options_.pairs;
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("pairs.jsonl"));
}

TEST_F(TrainProfileTest, AProfileThatCannotBeStoredIsAFailure) {
    write(lines());
    schema::RawConnection raw(collection_.path());
    schema::run_sql(raw.handle(),
                    "CREATE TRIGGER no_profiles BEFORE INSERT ON profiles"
                    " BEGIN SELECT raise(ABORT, 'no room'); END");
    EXPECT_EQ(train(), kExitFailed);
    EXPECT_TRUE(complained("cannot store"));
    EXPECT_TRUE(complained("no room"));
}

TEST_F(TrainProfileTest, TheProgramHasTheSameExitCodes) {
    write(lines());
    const auto run = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {HAARMONY_EVAL, "train"});
        return haarmony::testing::run(arguments);
    };
    EXPECT_EQ(run({"--help"}).exit_code, kExitStored);
    EXPECT_EQ(run({"--db", options_.database, "--pairs", options_.pairs}).exit_code,
              kExitUsage);
    const auto missing =
        run({"--db", "absent.db", "--pairs", options_.pairs, "--profile", "mine"});
    EXPECT_EQ(missing.exit_code, kExitFailed);
    const auto trained = run({"--db",
                              options_.database,
                              "--pairs",
                              options_.pairs,
                              "--profile",
                              "mine",
                              "--base",
                              "scanned",
                              "--kind",
                              "painted",
                              "--seed",
                              "3",
                              "--replace-worse"});
    EXPECT_EQ(trained.exit_code, kExitStored) << trained.err;
    EXPECT_NE(trained.out.find("stored as mine"), std::string::npos);
    EXPECT_EQ(collection_.service->profile("mine")->m, 40);
}

}  // namespace
}  // namespace haarmony::eval
