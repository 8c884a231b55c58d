// Whatever is in a snapshot file: refused with a reason, or read as what is written again as the
// same table. As the bytes come, and with checksums that fit, so that what is behind them is
// reached.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "server/app/snapshot_format.h"

namespace {

using namespace haarmony::server;

constexpr std::size_t kHeaderBytes = 96;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(std::span<const std::byte> file) {
    const auto table = decode_table(file);
    if (!table) {
        require(!table.error().message.empty());
        return;
    }
    require(table->file_bytes() == file.size());
    const std::vector<std::byte> again = encode_table(table.value());
    require(again.size() == table->parts_begin());
    // But for what fills the page, which has no meaning.
    const auto decoded = [&] {
        std::vector<std::byte> whole = again;
        whole.resize(file.size());
        return decode_table(whole);
    }();
    require(decoded && decoded.value() == table.value());
}

// The magic, the version, the file's size and both checksums, as a writer would put them.
void make_plausible(std::vector<std::byte>& file) {
    const SnapshotTable empty;
    const std::vector<std::byte> header = encode_table(empty);
    std::copy_n(header.begin(), 16, file.begin());
    const std::uint64_t size = file.size();
    std::memcpy(file.data() + 72, &size, sizeof size);
    std::uint64_t table_bytes = 0;
    std::memcpy(&table_bytes, file.data() + 64, sizeof table_bytes);
    const std::uint64_t begin = aligned_in_snapshot(
        kHeaderBytes + std::min<std::uint64_t>(table_bytes, file.size()));
    if (begin <= file.size()) {
        const std::uint64_t sum = snapshot_checksum(
            std::span(file).subspan(kHeaderBytes, begin - kHeaderBytes));
        std::memcpy(file.data() + 80, &sum, sizeof sum);
    }
    const std::uint64_t sum = snapshot_checksum(std::span(file).first(88));
    std::memcpy(file.data() + 88, &sum, sizeof sum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(input, size));
    check(bytes);
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    file.resize(aligned_in_snapshot(std::max(size, kHeaderBytes)));
    make_plausible(file);
    check(file);
    return 0;
}
