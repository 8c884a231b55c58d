#include "ingest/tiff_directory.h"

#include "ingest/byte_reader.h"

namespace haarmony::ingest {
namespace {

// Where the two layouts differ.
struct Layout {
    int offset_size;  // of offsets, and of the counts inside entries
    int count_size;   // of the number of entries
    std::uint64_t first_offset_at;
    [[nodiscard]] std::uint64_t entry_size() const { return 4 + 2 * offset_size; }
};

constexpr Layout kClassic = {4, 2, 4};
constexpr Layout kBig = {8, 8, 8};

int value_size(std::uint64_t type) {
    switch (type) {
        case 1:
            return 1;  // BYTE
        case 3:
            return 2;  // SHORT
        case 4:
            return 4;  // LONG
        case 16:
            return 8;  // LONG8
        default:
            return 0;
    }
}

std::optional<std::uint64_t> entry_value(const ByteReader& reader,
                                         const Layout& layout,
                                         std::uint64_t entry) {
    const int size = value_size(reader.u16(entry + 2).value_or(0));
    const auto count = reader.number(entry + 4, layout.offset_size);
    if (size == 0 || !count || *count == 0) return std::nullopt;
    const std::uint64_t field = entry + 4 + layout.offset_size;
    const bool fits = *count <= static_cast<std::uint64_t>(layout.offset_size / size);
    if (fits) return reader.number(field, size);
    const auto elsewhere = reader.number(field, layout.offset_size);
    return elsewhere ? reader.number(*elsewhere, size) : std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> first_directory_value(std::span<const std::uint8_t> tiff,
                                                   TiffTag tag) {
    if (tiff.size() < 2 || tiff[0] != tiff[1] || (tiff[0] != 'I' && tiff[0] != 'M')) {
        return std::nullopt;
    }
    const ByteReader reader(tiff, tiff[0] == 'I' ? ByteOrder::kLittle : ByteOrder::kBig);
    const std::uint64_t version = reader.u16(2).value_or(0);
    if (version != 42 && version != 43) return std::nullopt;
    const Layout layout = version == 42 ? kClassic : kBig;
    const auto directory = reader.number(layout.first_offset_at, layout.offset_size);
    const auto entries =
        directory ? reader.number(*directory, layout.count_size) : directory;
    if (!entries) return std::nullopt;
    std::uint64_t entry = *directory + layout.count_size;
    // A count of 2^64 ends where the bytes do.
    for (std::uint64_t i = 0; i < *entries; ++i, entry += layout.entry_size()) {
        const auto found = reader.u16(entry);
        if (!found) return std::nullopt;
        if (*found == static_cast<std::uint64_t>(tag)) {
            return entry_value(reader, layout, entry);
        }
    }
    return std::nullopt;
}

}  // namespace haarmony::ingest
