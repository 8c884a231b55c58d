#include "engine/core/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace haarmony {
namespace {

Error too_large() { return {ErrorCode::kTooLarge, "12 pixels, at most 10", "file"}; }

TEST(Result, OfAValueHoldsIt) {
    const Result<int> result = 7;
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(*result, 7);
}

TEST(Result, OfAnErrorHoldsAllOfIt) {
    const Result<int> result = too_large();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(result.error().message, "12 pixels, at most 10");
    EXPECT_EQ(result.error().param, "file");
}

TEST(Result, GivesAwayAValueThatCannotBeCopied) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
    const std::unique_ptr<int> taken = std::move(result).value();
    EXPECT_EQ(*taken, 5);
}

TEST(Result, TellsAnErrorFromAValueOfTypeErrorByItsPlace) {
    const Result<std::string> value = std::string("kept");
    EXPECT_EQ(value->size(), 4U);
}

TEST(Result, OfNothingIsAValueUnlessItFails) {
    EXPECT_TRUE(Result<void>().has_value());
    const Result<void> failed = too_large();
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::kTooLarge);
}

TEST(ResultDeathTest, TheWrongSideIsACallersBug) {
    const Result<int> value = 7;
    const Result<int> failed = too_large();
    EXPECT_DEBUG_DEATH((void)value.error(), "");
    EXPECT_DEBUG_DEATH((void)failed.value(), "");
}

}  // namespace
}  // namespace haarmony
