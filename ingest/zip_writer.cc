#include "ingest/zip_writer.h"

#include <zlib.h>

namespace haarmony::ingest {
namespace {

constexpr std::uint32_t kLocalHeader = 0x0403'4b50;
constexpr std::uint32_t kDirectoryHeader = 0x0201'4b50;
constexpr std::uint32_t kDirectoryEnd = 0x0605'4b50;
constexpr std::uint32_t kVersion = 10;  // 1.0: stored entries
constexpr std::uint32_t kFirstOfJanuary1980 = 1U << 5 | 1U;

using Bytes = std::vector<std::uint8_t>;

void u16(Bytes& bytes, std::uint64_t number) {
    bytes.push_back(static_cast<std::uint8_t>(number));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
}

void u32(Bytes& bytes, std::uint64_t number) {
    u16(bytes, number);
    u16(bytes, number >> 16);
}

// What both headers of an entry say, from the version on.
void describe(Bytes& bytes,
              std::uint32_t checksum,
              std::uint64_t size,
              std::size_t name) {
    u16(bytes, kVersion);
    u16(bytes, 0);  // flags
    u16(bytes, 0);  // stored
    u16(bytes, 0);  // midnight
    u16(bytes, kFirstOfJanuary1980);
    u32(bytes, checksum);
    u32(bytes, size);  // compressed
    u32(bytes, size);
    u16(bytes, name);
    u16(bytes, 0);  // extra fields
}

}  // namespace

Result<Bytes> ZipWriter::entry(const std::string& name,
                               std::span<const std::uint8_t> content) {
    if (entries_ == kMaxZipEntries) {
        return Error{ErrorCode::kTooLarge,
                     "a ZIP archive has at most " + std::to_string(kMaxZipEntries) +
                         " entries; " + name + " is one more"};
    }
    Bytes bytes;
    bytes.reserve(30 + name.size() + content.size());
    const auto checksum =
        static_cast<std::uint32_t>(crc32_z(0, content.data(), content.size()));
    u32(bytes, kLocalHeader);
    describe(bytes, checksum, content.size(), name.size());
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.insert(bytes.end(), content.begin(), content.end());

    Bytes listed;
    u32(listed, kDirectoryHeader);
    u16(listed, kVersion);  // made by
    describe(listed, checksum, content.size(), name.size());
    u16(listed, 0);  // comment
    u16(listed, 0);  // disk
    u16(listed, 0);  // internal attributes
    u32(listed, 0);  // external attributes
    u32(listed, offset_);
    listed.insert(listed.end(), name.begin(), name.end());

    if (content.size() > kMaxZipBytes ||
        offset_ + bytes.size() + directory_.size() + listed.size() > kMaxZipBytes) {
        return Error{ErrorCode::kTooLarge,
                     "with " + name + " (" + std::to_string(content.size()) +
                         " bytes) the ZIP archive would be larger than 4 GiB"};
    }
    offset_ += bytes.size();
    directory_.insert(directory_.end(), listed.begin(), listed.end());
    ++entries_;
    return bytes;
}

Bytes ZipWriter::end() const {
    Bytes bytes = directory_;
    u32(bytes, kDirectoryEnd);
    u16(bytes, 0);  // this disk
    u16(bytes, 0);  // the directory's disk
    u16(bytes, static_cast<std::uint64_t>(entries_));
    u16(bytes, static_cast<std::uint64_t>(entries_));
    u32(bytes, directory_.size());
    u32(bytes, offset_);
    u16(bytes, 0);  // comment
    return bytes;
}

}  // namespace haarmony::ingest
