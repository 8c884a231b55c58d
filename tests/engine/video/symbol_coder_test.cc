// Symbols in contexts, there and back.
#include "engine/video/symbol_coder.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/video/brick_coder.h"
#include "engine/video/byte_stream.h"

namespace haarmony::video {
namespace {

struct Symbol {
    int lane;
    int context;
    std::uint8_t value;
};

// Contexts of very different statistics, on all lanes.
std::vector<Symbol> random_symbols(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Symbol> symbols;
    for (std::size_t i = 0; i < count; ++i) {
        const int context = static_cast<int>(random() % kContexts);
        const std::uint32_t width =
            1U << random() % (1 + static_cast<unsigned>(context) % 9);
        symbols.push_back({static_cast<int>(random() % kLanes),
                           context,
                           static_cast<std::uint8_t>(random() % width)});
    }
    return symbols;
}

std::vector<std::byte> coded(const std::vector<Symbol>& symbols) {
    SymbolWriter writer;
    for (const Symbol& symbol : symbols)
        writer.put(symbol.lane, symbol.context, symbol.value);
    std::vector<std::byte> bytes;
    SymbolCosts costs = first_costs();
    writer.finish(bytes, costs);
    return bytes;
}

std::uint8_t next(SymbolCursor& cursor, int lane, int context) {
    return lane == 0   ? cursor.next<0>(context)
           : lane == 1 ? cursor.next<1>(context)
                       : cursor.next<2>(context);
}

TEST(SymbolCoder, WhatIsWrittenIsRead) {
    for (const std::size_t count : {0U, 1U, 2U, 100U, 20'000U}) {
        const std::vector<Symbol> symbols =
            random_symbols(count, static_cast<std::uint32_t>(count));
        const std::vector<std::byte> bytes = coded(symbols);
        Result<SymbolReader> reader = SymbolReader::open(bytes);
        ASSERT_TRUE(reader.has_value()) << count;
        for (const Symbol& symbol : symbols)
            ASSERT_EQ(next((*reader).cursor(), symbol.lane, symbol.context),
                      symbol.value);
        EXPECT_TRUE((*reader).at_end()) << count;
    }
}

TEST(SymbolCoder, ASymbolThatIsAlwaysTheSameCostsNothing) {
    std::vector<Symbol> symbols(100'000, {1, 17, 200});
    EXPECT_EQ(coded(symbols).size(), coded({symbols.front()}).size());
}

TEST(SymbolCoder, FairCoinsCostABitEach) {
    std::mt19937 random(4);
    std::vector<Symbol> symbols;
    for (int i = 0; i < 80'000; ++i)
        symbols.push_back({i % kLanes, 3, static_cast<std::uint8_t>(random() % 2)});
    EXPECT_NEAR(static_cast<double>(coded(symbols).size()), 10'000, 100);
}

TEST(SymbolCoder, ContextsWithOtherStatisticsGetOtherTables) {
    std::vector<Symbol> symbols;
    for (int i = 0; i < 40'000; ++i)
        symbols.push_back({0, i % 2, static_cast<std::uint8_t>(i % 2 == 0 ? 5 : 250)});
    EXPECT_LT(coded(symbols).size(), 100U);
}

TEST(SymbolCoder, AnEndThatDoesNotComeIsNoticed) {
    const std::vector<Symbol> symbols = random_symbols(3000, 9);
    const std::vector<std::byte> bytes = coded(symbols);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        Result<SymbolReader> reader = SymbolReader::open(std::span(bytes).first(length));
        if (!reader) {
            EXPECT_EQ(reader.error().code, ErrorCode::kUndecodable);
            continue;
        }
        for (const Symbol& symbol : symbols)
            (void)next((*reader).cursor(), symbol.lane, symbol.context);
        EXPECT_FALSE((*reader).at_end()) << length;
    }
}

TEST(SymbolCoder, CostsFollowWhatWasCoded) {
    SymbolWriter writer;
    for (int i = 0; i < 1000; ++i)
        writer.put(0, 7, static_cast<std::uint8_t>(i % 100 == 0));
    std::vector<std::byte> bytes;
    SymbolCosts costs = first_costs();
    const SymbolCosts before = costs;
    writer.finish(bytes, costs);
    EXPECT_LT(costs[7][0], 256 / 10);
    EXPECT_GT(costs[7][1], 256 * 6);
    EXPECT_EQ(costs[8], before[8]);
}

TEST(SymbolCoder, TablesThatAreNoneAreRefused) {
    const auto refused = [](const std::vector<std::byte>& bytes, const char* what) {
        const Result<SymbolReader> reader = SymbolReader::open(bytes);
        ASSERT_FALSE(reader.has_value()) << what;
        EXPECT_NE(reader.error().message.find(what), std::string::npos)
            << reader.error().message;
    };
    const auto numbers = [](std::initializer_list<std::uint64_t> values) {
        std::vector<std::byte> bytes;
        for (const std::uint64_t value : values) put_varint(bytes, value);
        return bytes;
    };
    refused(numbers({0}), "number of tables");
    refused(numbers({kMaxTables + 1}), "number of tables");
    refused(numbers({1, 0, 0}), "table of a context");
    refused(numbers({1, kContexts + 1, 0}), "table of a context");
    refused(numbers({1, kContexts, 1}), "table of a context");
    refused(numbers({1, kContexts, 0, kTableParts + 1}), "frequencies");
    refused(numbers({1, kContexts, 0, 0, 0}), "frequencies");
    refused(numbers({1, kContexts, 0, 0, 256, 1}), "frequencies");
    std::vector<std::byte> low = numbers({1, kContexts, 0, kTableParts});
    put_fixed(low, kLowestState - 1);
    refused(low, "state");
}

}  // namespace
}  // namespace haarmony::video
