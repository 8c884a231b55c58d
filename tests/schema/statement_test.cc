#include "schema/statement.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <limits>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"

namespace haarmony::schema {
namespace {

Statement prepared(const RawConnection& connection, std::string_view sql) {
    return expect(Statement::prepare(connection.handle(), sql));
}

TEST(Statement, GivesBackWhatWasBound) {
    const RawConnection memory(":memory:");
    Statement echo = prepared(memory, "SELECT ?1, ?2, ?3, ?4");
    const std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    const std::string text("with \0 inside, and \xc3\xa9", 22);
    const auto bytes = some_bytes(1, 300);
    echo.bind(1, lowest);
    echo.bind(2, text);
    echo.bind(3, bytes);
    ASSERT_TRUE(expect(echo.step()));
    EXPECT_EQ(echo.integer(0), lowest);
    EXPECT_EQ(echo.text(1), text);
    const auto read = echo.bytes(2);
    EXPECT_EQ(std::vector<std::uint8_t>(read.begin(), read.end()), bytes);
    EXPECT_TRUE(echo.is_null(3));
    EXPECT_FALSE(expect(echo.step()));
}

TEST(Statement, BindsEmptyTextAndBytesAsEmptyAndNotAsNull) {
    const RawConnection memory(":memory:");
    Statement echo = prepared(memory, "SELECT ?1, ?2, typeof(?1), typeof(?2)");
    echo.bind(1, std::string_view());
    echo.bind(2, std::span<const std::uint8_t>());
    ASSERT_TRUE(expect(echo.step()));
    EXPECT_EQ(echo.text(0), "");
    EXPECT_TRUE(echo.bytes(1).empty());
    EXPECT_EQ(echo.text(2), "text");
    EXPECT_EQ(echo.text(3), "blob");
}

TEST(Statement, ResetForgetsTheParameters) {
    const RawConnection memory(":memory:");
    Statement echo = prepared(memory, "SELECT ?1");
    echo.bind(1, 7);
    ASSERT_TRUE(expect(echo.step()));
    echo.reset();
    ASSERT_TRUE(expect(echo.step()));
    EXPECT_TRUE(echo.is_null(0));
}

TEST(Statement, BadSqlIsAnErrorWithSqlitesWords) {
    const RawConnection memory(":memory:");
    const auto result = Statement::prepare(memory.handle(), "SELECT nonsense");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kIo);
    EXPECT_NE(result.error().message.find("no such column: nonsense"), std::string::npos)
        << result.error().message;
}

TEST(Statement, AFailedBindIsReportedByTheNextStep) {
    const RawConnection memory(":memory:");
    Statement echo = prepared(memory, "SELECT ?1");
    echo.bind(2, 1);  // there is no second parameter
    const auto row = echo.step();
    ASSERT_FALSE(row);
    EXPECT_NE(row.error().message.find("out of range"), std::string::npos)
        << row.error().message;
    echo.reset();
    EXPECT_TRUE(expect(echo.step()));
}

TEST(Statement, ATooLongValueIsTooLarge) {
    const RawConnection memory(":memory:");
    sqlite3_limit(memory.handle(), SQLITE_LIMIT_LENGTH, 100);
    Statement echo = prepared(memory, "SELECT ?1");
    const std::string text(101, 'x');
    echo.bind(1, text);
    const auto row = echo.step();
    ASSERT_FALSE(row);
    EXPECT_EQ(row.error().code, ErrorCode::kTooLarge) << row.error().message;
}

TEST(StatementCache, PreparesEachStatementOnce) {
    const RawConnection memory(":memory:");
    StatementCache cache(memory.handle());
    const auto prepared_now = [&] {
        int count = 0;
        for (sqlite3_stmt* statement = sqlite3_next_stmt(memory.handle(), nullptr);
             statement != nullptr;
             statement = sqlite3_next_stmt(memory.handle(), statement)) {
            ++count;
        }
        return count;
    };
    for (int i = 0; i < 3; ++i) {
        auto loan = expect(cache.borrow("SELECT 1"));
        EXPECT_TRUE(expect(loan->step()));
        EXPECT_EQ(prepared_now(), 1);
    }
    EXPECT_EQ(prepared_now(), 1);
}

TEST(StatementCache, AStatementInUseIsLentASecondTimeAsItsTwin) {
    const RawConnection memory(":memory:");
    StatementCache cache(memory.handle());
    constexpr std::string_view sql = "SELECT ?1 UNION ALL SELECT ?1 + 1";
    auto outer = expect(cache.borrow(sql));
    outer->bind(1, 10);
    ASSERT_TRUE(expect(outer->step()));
    {
        auto inner = expect(cache.borrow(sql));
        inner->bind(1, 20);
        ASSERT_TRUE(expect(inner->step()));
        EXPECT_EQ(inner->integer(0), 20);
    }
    EXPECT_EQ(outer->integer(0), 10);
    ASSERT_TRUE(expect(outer->step()));
    EXPECT_EQ(outer->integer(0), 11);
}

TEST(StatementCache, AReturnedStatementHoldsNoReadLock) {
    const RawConnection memory(":memory:");
    StatementCache cache(memory.handle());
    {
        auto loan = expect(cache.borrow("SELECT 1 UNION ALL SELECT 2"));
        ASSERT_TRUE(expect(loan->step()));
    }
    EXPECT_EQ(sqlite3_next_stmt(memory.handle(), nullptr) != nullptr &&
                  sqlite3_stmt_busy(sqlite3_next_stmt(memory.handle(), nullptr)) != 0,
              false);
}

}  // namespace
}  // namespace haarmony::schema
