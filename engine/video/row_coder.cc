#include "engine/video/row_coder.h"

#include <algorithm>
#include <cstring>

namespace haarmony::video {
namespace {

constexpr std::size_t kColorRows = 3 * kBrickSide;
constexpr std::size_t kMostBytes =
    kRows * sizeof(std::uint64_t);  // of a brick in a stream
constexpr int kTriples = kRowClasses * kRowClasses * kRowClasses;
constexpr std::uint8_t kNoClass = kRowClasses;

// How many bytes of each class a brick has had so far, side by side in one word: counters in
// memory would wait for each other.
class ClassCounts {
  public:
    static constexpr int kBits = 10;  // 256 at most
    [[nodiscard]] std::size_t of(std::size_t row_class) const {
        return counts_ >> kBits * row_class & ((1U << kBits) - 1);
    }
    void add(std::uint64_t step) { counts_ += step; }

  private:
    std::uint64_t counts_ = 0;
};
static_assert(ClassCounts::kBits * kRowClasses <= 64);

// What a row adds to them: its packed bytes, or its residuals.
constexpr auto kPackedStep = [] {
    std::array<std::uint64_t, kRowClasses> made{};
    for (std::size_t c = 0; c < kRowClasses; ++c)
        made[c] = std::uint64_t{kRowBytes[c]} << ClassCounts::kBits * c;
    return made;
}();
constexpr auto kUnpackedStep = [] {
    std::array<std::uint64_t, kRowClasses> made{};
    for (std::size_t c = 1; c < kRowClasses; ++c)
        made[c] = std::uint64_t{kBrickSide} << ClassCounts::kBits * c;
    return made;
}();

struct Triple {
    std::array<std::uint8_t, 3> plane;
};
// Green, red and blue of a byte of classes. Bytes that are none are rows of zeros.
constexpr std::array<Triple, 256> kTripleOf = [] {
    std::array<Triple, 256> made{};
    for (int i = 0; i < kTriples; ++i) {
        made[static_cast<std::size_t>(i)].plane = {
            static_cast<std::uint8_t>(i % kRowClasses),
            static_cast<std::uint8_t>(i / kRowClasses % kRowClasses),
            static_cast<std::uint8_t>(i / (kRowClasses * kRowClasses))};
    }
    return made;
}();

// Rows of so many bits a residual, packed and again a byte each.
template <int kBits>
std::uint64_t unpacked(std::uint64_t bits) {
    if constexpr (kBits == 1) {
        constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101;
        // Each byte keeps its own bit, the lowest byte the lowest.
        bits = bits * kOnes & 0x8040'2010'0804'0201;
        // Its top bit is set where any is, and then all are.
        bits = (bits + 0x7F * kOnes) >> 7 & kOnes;
        return bits * 0xFF;
    } else if constexpr (kBits == 2) {
        bits = (bits | bits << 24) & 0x0000'00FF'0000'00FF;
        bits = (bits | bits << 12) & 0x000F'000F'000F'000F;
        bits = (bits | bits << 6) & 0x0303'0303'0303'0303;
        return bits | (bits & 0x0202'0202'0202'0202) * (0xFC / 2);
    } else {
        static_assert(kBits == 4);
        bits = (bits | bits << 16) & 0x0000'FFFF'0000'FFFF;
        bits = (bits | bits << 8) & 0x00FF'00FF'00FF'00FF;
        bits = (bits | bits << 4) & 0x0F0F'0F0F'0F0F'0F0F;
        return bits | (bits & 0x0808'0808'0808'0808) * (0xF0 / 8);
    }
}

template <int kBits>
void unpack_rows(const std::uint8_t* packed, std::size_t rows, std::uint8_t* out) {
    for (std::size_t row = 0; row < rows; ++row) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, packed + row * kBits, kBits);
        bits = unpacked<kBits>(bits);
        std::memcpy(out + row * sizeof bits, &bits, sizeof bits);
    }
}

}  // namespace

std::uint8_t* RowWriter::Bytes::room() {
    if (bytes.size() - used < kMostBytes) bytes.resize(2 * bytes.size() + 4 * kMostBytes);
    return bytes.data() + used;
}

void RowWriter::put(const PackedRows& rows, bool alpha) {
    std::uint8_t* const classes = rows_[kColorClasses].room();
    for (std::size_t y = 0; y < kBrickSide; ++y) {
        classes[y] = static_cast<std::uint8_t>(
            rows.row_class[y] + kRowClasses * rows.row_class[kBrickSide + y] +
            kRowClasses * kRowClasses * rows.row_class[2 * kBrickSide + y]);
    }
    rows_[kColorClasses].used += kBrickSide;
    if (alpha) {
        std::uint8_t* const own = alpha_classes_.room();
        for (std::size_t y = 0; y < kBrickSide; ++y)
            own[y] = static_cast<std::uint8_t>(rows.row_class[kColorRows + y]);
        alpha_classes_.used += kBrickSide;
    }
    std::array<std::uint8_t, sizeof(std::uint64_t)> nothing;
    std::array<std::uint8_t*, kRowClasses> to;
    to[0] = nothing.data();
    for (std::size_t c = 1; c < kRowClasses; ++c) to[c] = rows_[c].room();
    ClassCounts counts;
    for (std::size_t row = 0; row < (alpha ? kRows : kColorRows); ++row) {
        const std::size_t c = rows.row_class[row];
        std::memcpy(to[c] + counts.of(c), &rows.bytes[row], sizeof rows.bytes[row]);
        counts.add(kPackedStep[c]);
    }
    for (std::size_t c = 1; c < kRowClasses; ++c) rows_[c].used += counts.of(c);
}

void RowWriter::finish(std::vector<std::byte>& out) const {
    // Many large residuals are edges that moved, and more of them are alike than of those that
    // grain leaves. Such pictures are drawn, and have few bricks: there is time for a long look.
    std::size_t all = 0;
    for (std::size_t c = 1; c < kRowClasses; ++c) all += rows_[c].used;
    const bool drawn = 8 * rows_.back().used > all;
    const Redundancy redundancy = drawn ? Redundancy::kSearched : Redundancy::kFrequent;
    for (const Bytes& bytes : rows_)
        put_stream(std::span(bytes.bytes).first(bytes.used), redundancy, out);
    put_stream(std::span(alpha_classes_.bytes).first(alpha_classes_.used),
               Redundancy::kRepeated,
               out);
}

Result<RowReader> RowReader::open(StreamReader& reader, std::uint64_t bricks) {
    RowReader made;
    const auto take = [&reader](std::uint64_t most, Stream& stream) -> Result<void> {
        Result<Stream> found = reader.next(most);
        if (!found) return std::move(found).error();
        stream = *std::move(found);
        return {};
    };
    if (Result<void> done = take(bricks * kBrickSide, made.classes_[0]); !done)
        return done.error();
    // Together they have no more rows than the bricks.
    std::uint64_t rows_left = bricks * kRows;
    for (std::size_t c = 1; c < kRowClasses; ++c) {
        Rows& rows = made.rows_[c];
        if (Result<void> done = take(rows_left * kRowBytes[c], rows.packed); !done)
            return done.error();
        rows_left -= rows.packed.size() / kRowBytes[c];
        rows.unpacked.resize(8 * kMostBytes);
    }
    made.rows_[0].unpacked.resize(sizeof(std::uint64_t));
    if (Result<void> done = take(bricks * kBrickSide, made.classes_[1]); !done)
        return done.error();
    return made;
}

void RowReader::refill(std::size_t row_class) {
    Rows& rows = rows_[row_class];
    std::uint8_t* const start = rows.unpacked.data();
    std::memmove(start, start + rows.begin, rows.end - rows.begin);
    rows.end -= rows.begin;
    rows.begin = 0;
    const std::size_t row_bytes = kRowBytes[row_class];
    const std::size_t count = std::min((rows.unpacked.size() - rows.end) / kBrickSide,
                                       (rows.packed.size() - rows.next) / row_bytes);
    const std::uint8_t* const from = rows.packed.data() + rows.next;
    std::uint8_t* const to = start + rows.end;
    switch (row_bytes) {
        case 1:
            unpack_rows<1>(from, count, to);
            break;
        case 2:
            unpack_rows<2>(from, count, to);
            break;
        case 4:
            unpack_rows<4>(from, count, to);
            break;
        default:
            std::copy_n(from, count * row_bytes, to);
            break;
    }
    rows.next += count * row_bytes;
    rows.end += count * kBrickSide;
}

void RowReader::take_classes(std::size_t stream,
                             std::array<std::uint8_t, kBrickSide>& classes) {
    const Stream& from = classes_[stream];
    std::size_t& at = next_class_[stream];
    if (from.size() - at < kBrickSide) {
        damaged_ = true;
        classes.fill(0);
        return;
    }
    std::memcpy(classes.data(), from.data() + at, kBrickSide);
    at += kBrickSide;
}

void RowReader::next(bool alpha, Residuals& residuals) {
    std::array<std::uint8_t, kBrickSide> colors;
    take_classes(0, colors);
    std::array<std::uint8_t, kRows> classes;
    std::uint8_t highest = 0;
    for (std::size_t y = 0; y < kBrickSide; ++y) {
        highest = std::max(highest, colors[y]);
        const Triple& triple = kTripleOf[colors[y]];
        for (std::size_t plane = 0; plane < 3; ++plane)
            classes[plane * kBrickSide + y] = triple.plane[plane];
    }
    if (highest >= kTriples) damaged_ = true;
    if (alpha) {
        std::array<std::uint8_t, kBrickSide> own;
        take_classes(1, own);
        for (std::size_t y = 0; y < kBrickSide; ++y) {
            if (own[y] >= kRowClasses) {
                damaged_ = true;
                own[y] = 0;
            }
            classes[kColorRows + y] = own[y];
        }
    }
    std::array<const std::uint8_t*, kRowClasses> from;
    for (std::size_t c = 1; c < kRowClasses; ++c) {
        if (rows_[c].end - rows_[c].begin < kMostBytes) refill(c);
        from[c] = rows_[c].unpacked.data() + rows_[c].begin;
    }
    from[0] = rows_[0].unpacked.data();
    ClassCounts counts;
    for (std::size_t row = 0; row < (alpha ? kRows : kColorRows); ++row) {
        const std::size_t c = classes[row];
        std::memcpy(
            residuals.data() + row * kBrickSide, from[c] + counts.of(c), kBrickSide);
        counts.add(kUnpackedStep[c]);
    }
    for (std::size_t c = 1; c < kRowClasses; ++c) {
        Rows& rows = rows_[c];
        rows.begin += counts.of(c);
        if (rows.begin > rows.end) {
            damaged_ = true;
            rows.begin = rows.end;
        }
    }
}

bool RowReader::at_end() const {
    bool all = !damaged_;
    for (std::size_t i = 0; i < classes_.size(); ++i)
        all = all && next_class_[i] == classes_[i].size();
    for (const Rows& rows : rows_)
        all = all && rows.begin == rows.end && rows.next == rows.packed.size();
    return all;
}

}  // namespace haarmony::video
