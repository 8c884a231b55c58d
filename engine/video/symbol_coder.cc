#include "engine/video/symbol_coder.h"

#include <algorithm>
#include <cmath>

#include "engine/video/byte_stream.h"

namespace haarmony::video {
namespace {

using Histogram = std::array<std::uint32_t, kSymbols>;
using Frequencies = std::array<std::uint16_t, kSymbols>;

// n log2 n.
double weighted_log(std::uint32_t n) {
    static const std::vector<double> small = [] {
        std::vector<double> table(4096, 0.0);
        for (std::size_t i = 2; i < table.size(); ++i)
            table[i] = static_cast<double>(i) * std::log2(static_cast<double>(i));
        return table;
    }();
    if (n < small.size()) return small[n];
    return static_cast<double>(n) * std::log2(static_cast<double>(n));
}

// What a symbol's frequency costs in a table, in bits: found on natural clips.
constexpr double kEntryBits = 10;

struct Cluster {
    Histogram count{};
    std::uint32_t total = 0;
    int end = 0;  // behind the last symbol that occurs
    double bits = 0;
};

double coded_bits(const Cluster& cluster) {
    double logs = 0;
    int entries = 0;
    for (int symbol = 0; symbol < cluster.end; ++symbol) {
        const std::uint32_t count = cluster.count[symbol];
        if (count == 0) continue;
        logs += weighted_log(count);
        ++entries;
    }
    return weighted_log(cluster.total) - logs + kEntryBits * entries;
}

Cluster joined(const Cluster& a, const Cluster& b) {
    Cluster sum = a;
    sum.total += b.total;
    sum.end = std::max(a.end, b.end);
    for (int symbol = 0; symbol < b.end; ++symbol) sum.count[symbol] += b.count[symbol];
    sum.bits = coded_bits(sum);
    return sum;
}

struct Clustering {
    std::array<std::uint8_t, kContexts> table_of{};
    std::vector<Cluster> tables;
};

// Greedy, the most frequent contexts first: each joins the table where it costs least, or
// opens its own.
Clustering cluster(std::vector<Cluster>& contexts) {
    std::vector<int> order;
    for (int context = 0; context < kContexts; ++context) {
        if (contexts[context].total > 0) order.push_back(context);
    }
    std::stable_sort(order.begin(), order.end(), [&contexts](int a, int b) {
        return contexts[a].total > contexts[b].total;
    });
    Clustering made;
    std::array<bool, kContexts> used{};
    for (const int context : order) {
        Cluster& own = contexts[context];
        own.bits = coded_bits(own);
        const bool full = made.tables.size() == kMaxTables;
        std::size_t best = made.tables.size();
        double least = full ? INFINITY : own.bits;
        Cluster best_sum;
        for (std::size_t t = 0; t < made.tables.size(); ++t) {
            Cluster sum = joined(made.tables[t], own);
            const double more = sum.bits - made.tables[t].bits;
            if (more >= least) continue;
            least = more;
            best = t;
            best_sum = sum;
        }
        if (best == made.tables.size()) {
            made.tables.push_back(own);
        } else {
            made.tables[best] = best_sum;
        }
        made.table_of[context] = static_cast<std::uint8_t>(best);
        used[context] = true;
    }
    if (made.tables.empty()) {
        Cluster& one = made.tables.emplace_back();
        one.count[0] = one.total = 1;
        one.end = 1;
    }
    // A context without symbols repeats the one before it: runs are long, and cost little.
    for (int context = 1; context < kContexts; ++context) {
        if (!used[context]) made.table_of[context] = made.table_of[context - 1];
    }
    return made;
}

// Counts scaled to kTableParts; what occurs keeps at least one part.
Frequencies scaled(const Cluster& cluster) {
    Frequencies frequency{};
    std::uint32_t sum = 0;
    int largest = 0;
    for (int symbol = 0; symbol < cluster.end; ++symbol) {
        const std::uint64_t count = cluster.count[symbol];
        if (count == 0) continue;
        frequency[symbol] = static_cast<std::uint16_t>(
            std::max<std::uint64_t>(1, count * kTableParts / cluster.total));
        sum += frequency[symbol];
        if (frequency[symbol] > frequency[largest]) largest = symbol;
    }
    if (sum < kTableParts) {
        frequency[largest] =
            static_cast<std::uint16_t>(frequency[largest] + kTableParts - sum);
    }
    while (sum > kTableParts) {
        const auto most = std::max_element(frequency.begin(), frequency.end());
        const std::uint32_t less = std::min<std::uint32_t>(sum - kTableParts, *most / 4U);
        *most = static_cast<std::uint16_t>(*most - less);
        sum -= less;
    }
    return frequency;
}

void write_tables(const Clustering& clustering,
                  const std::vector<Frequencies>& tables,
                  std::vector<std::byte>& out) {
    put_varint(out, tables.size());
    for (int context = 0; context < kContexts;) {
        int end = context + 1;
        while (end < kContexts &&
               clustering.table_of[end] == clustering.table_of[context])
            ++end;
        put_varint(out, static_cast<std::uint64_t>(end - context));
        put_varint(out, clustering.table_of[context]);
        context = end;
    }
    for (const Frequencies& table : tables) {
        std::uint32_t left = kTableParts;
        for (int symbol = 0; left > 0;) {
            if (table[symbol] > 0) {
                put_varint(out, table[symbol]);
                left -= table[symbol++];
                continue;
            }
            int end = symbol + 1;
            while (table[end] == 0) ++end;
            put_varint(out, 0);
            put_varint(out, static_cast<std::uint64_t>(end - symbol));
            symbol = end;
        }
    }
}

void learn(const Clustering& clustering,
           const std::vector<Frequencies>& tables,
           const std::vector<Cluster>& contexts,
           SymbolCosts& costs) {
    static const std::array<std::uint16_t, kTableParts + 1> cost_of = [] {
        std::array<std::uint16_t, kTableParts + 1> table{};
        // What does not occur in a table can occur in the next chunk's.
        table[0] = 256 * (kTableBits + 2);
        for (std::uint32_t f = 1; f <= kTableParts; ++f) {
            const double bits = kTableBits - std::log2(static_cast<double>(f));
            table[f] = static_cast<std::uint16_t>(std::lround(256 * bits));
        }
        return table;
    }();
    for (int context = 0; context < kContexts; ++context) {
        if (contexts[context].total == 0) continue;
        const Frequencies& table = tables[clustering.table_of[context]];
        for (int symbol = 0; symbol < kSymbols; ++symbol)
            costs[context][symbol] = cost_of[table[symbol]];
    }
}

Error damaged(const char* what) {
    return {ErrorCode::kUndecodable, std::string("entropy coder: ") + what};
}

}  // namespace

void SymbolWriter::finish(std::vector<std::byte>& out, SymbolCosts& costs) {
    std::vector<Cluster> contexts(kContexts);
    for (const Symbol& symbol : symbols_) {
        Cluster& context = contexts[symbol.context];
        ++context.count[symbol.symbol];
        ++context.total;
        context.end = std::max(context.end, symbol.symbol + 1);
    }
    const Clustering clustering = cluster(contexts);
    std::vector<Frequencies> tables;
    std::vector<std::array<std::uint16_t, kSymbols>> begins;
    for (const Cluster& table : clustering.tables) {
        tables.push_back(scaled(table));
        std::uint32_t begin = 0;
        auto& row = begins.emplace_back();
        for (int symbol = 0; symbol < kSymbols; ++symbol) {
            row[symbol] = static_cast<std::uint16_t>(begin);
            begin += tables.back()[symbol];
        }
    }
    write_tables(clustering, tables, out);
    learn(clustering, tables, contexts, costs);

    // The decoder reads forwards what is coded backwards.
    std::array<std::uint32_t, kLanes> states;
    states.fill(kLowestState);
    std::vector<std::uint16_t> words;
    for (auto symbol = symbols_.rbegin(); symbol != symbols_.rend(); ++symbol) {
        const std::size_t table = clustering.table_of[symbol->context];
        const std::uint32_t frequency = tables[table][symbol->symbol];
        std::uint32_t& state = states[symbol->lane];
        if (state >= std::uint64_t{frequency} << (32 - kTableBits)) {
            words.push_back(static_cast<std::uint16_t>(state));
            state >>= 16;
        }
        state = (state / frequency << kTableBits) + state % frequency +
                begins[table][symbol->symbol];
    }
    for (const std::uint32_t state : states) put_fixed(out, state);
    for (auto word = words.rbegin(); word != words.rend(); ++word) put_fixed(out, *word);
    symbols_.clear();
}

Result<SymbolReader> SymbolReader::open(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    const std::uint64_t tables = in.varint();
    if (tables == 0 || tables > kMaxTables) return damaged("number of tables");
    SymbolReader reader;
    reader.tables_->parts.resize(tables << kTableBits);
    for (std::size_t context = 0; context < kContexts;) {
        const std::uint64_t run = in.varint();
        const std::uint64_t table = in.varint();
        if (run == 0 || run > kContexts - context || table >= tables)
            return damaged("table of a context");
        std::fill_n(reader.tables_->of_context.begin() + context,
                    run,
                    reader.tables_->parts.data() + (table << kTableBits));
        context += run;
    }
    for (std::uint64_t table = 0; table < tables; ++table) {
        std::uint32_t* part = reader.tables_->parts.data() + (table << kTableBits);
        std::uint32_t left = kTableParts;
        for (std::uint32_t symbol = 0; left > 0;) {
            if (symbol >= kSymbols) return damaged("frequencies of a table");
            const std::uint64_t frequency = in.varint();
            if (frequency == 0) {
                const std::uint64_t run = in.varint();
                if (run == 0 || run > kSymbols) return damaged("frequencies of a table");
                symbol += static_cast<std::uint32_t>(run);
                continue;
            }
            if (frequency > left) return damaged("frequencies of a table");
            for (std::uint32_t i = 0; i < frequency; ++i)
                *part++ = symbol << 24 | i << 12 | static_cast<std::uint32_t>(frequency);
            left -= static_cast<std::uint32_t>(frequency);
            ++symbol;
        }
    }
    for (std::uint32_t& state : reader.cursor_.states_) {
        state = in.fixed<std::uint32_t>();
        if (state < kLowestState) return damaged("state");
    }
    if (in.overrun()) return damaged("tables cut off");
    const std::span<const std::byte> words = in.rest();
    reader.cursor_.tables_ = &reader.tables_->of_context;
    reader.cursor_.at_ = words.data();
    reader.cursor_.end_ = words.data() + words.size();
    return reader;
}

bool SymbolReader::at_end() const {
    const auto& states = cursor_.states_;
    return !cursor_.overrun_ && cursor_.at_ == cursor_.end_ &&
           std::all_of(states.begin(), states.end(), [](std::uint32_t state) {
               return state == kLowestState;
           });
}

}  // namespace haarmony::video
