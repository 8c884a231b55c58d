#include "tests/eval/signature_cache.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <type_traits>

namespace haarmony::eval {
namespace {

constexpr std::array<char, 8> kMagic = {'H', 'A', 'A', 'R', 'S', 'Y', 'N', '\n'};
constexpr std::uint32_t kFormat = 1;
// Changes whenever other pictures are made from the same seed and photos.
constexpr std::uint32_t kRecipes = 1;

struct Header {
    std::array<char, 8> magic = kMagic;
    std::uint32_t format = kFormat;
    std::uint32_t recipes = kRecipes;
    std::uint64_t seed = 0;
    std::uint64_t source_digest = 0;
    std::uint64_t images = 0;
    std::uint32_t queries = 0;
    std::array<std::uint8_t, 20> zero{};
};
static_assert(sizeof(Header) == 64 && std::is_trivially_copyable_v<Header>);
static_assert(std::is_trivially_copyable_v<SyntheticQuery>);

// FNV-1a over words of eight bytes.
class Checksum {
  public:
    void add(std::span<const std::byte> bytes) {
        assert(bytes.size() % 8 == 0);
        for (std::size_t i = 0; i < bytes.size(); i += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i, 8);
            hash_ = (hash_ ^ word) * 1099511628211U;
        }
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 14695981039346656037U;
};
static_assert(sizeof(SyntheticQuery) % 8 == 0 && sizeof(PackedSignature) % 8 == 0);
static_assert(sizeof(CellBytes) % 8 == 0 && sizeof(HistogramCounts) % 8 == 0);

class Writer {
  public:
    explicit Writer(const std::string& path) : out_(path, std::ios::binary) {}

    template <typename T>
    void put(std::span<const T> values) {
        const auto bytes = std::as_bytes(values);
        checksum_.add(bytes);
        write(bytes);
    }
    void put_checksum() {
        const std::uint64_t value = checksum_.value();
        write(std::as_bytes(std::span(&value, 1)));
        checksum_ = {};
    }
    [[nodiscard]] bool finish() {
        out_.close();
        return bool(out_);
    }

  private:
    void write(std::span<const std::byte> bytes) {
        out_.write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    std::ofstream out_;
    Checksum checksum_;
};

class Reader {
  public:
    explicit Reader(const std::string& path) : in_(path, std::ios::binary) {}

    [[nodiscard]] bool is_open() const { return in_.is_open(); }

    template <typename T>
    [[nodiscard]] bool get(std::span<T> values) {
        const auto bytes = std::as_writable_bytes(values);
        in_.read(reinterpret_cast<char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
        checksum_.add(bytes);
        return bool(in_);
    }
    [[nodiscard]] bool get_checksum() {
        std::uint64_t expected = 0;
        in_.read(reinterpret_cast<char*>(&expected), sizeof expected);
        const bool equal = in_ && expected == checksum_.value();
        checksum_ = {};
        return equal;
    }
    void skip(std::uint64_t bytes) {
        in_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    }

  private:
    std::ifstream in_;
    Checksum checksum_;
};

// `images`: how many are wanted, or 0 for all there are.
Result<SyntheticCollection> read(const std::string& path,
                                 std::int64_t images,
                                 bool with_features) {
    Reader in(path);
    if (!in.is_open()) return Error{ErrorCode::kNotFound, path + ": cannot be opened"};
    const auto damaged = [&](const char* what) {
        return Error{ErrorCode::kUndecodable, path + ": " + what + " damaged"};
    };
    Header header;
    if (!in.get(std::span(&header, 1)) || header.magic != kMagic)
        return Error{ErrorCode::kUnsupportedFormat, path + ": no cache of signatures"};
    if (header.format != kFormat || header.recipes != kRecipes) {
        return Error{ErrorCode::kUnsupportedFormat,
                     path + ": version " + std::to_string(header.format) + "." +
                         std::to_string(header.recipes) + ", not " +
                         std::to_string(kFormat) + "." + std::to_string(kRecipes)};
    }
    if (!in.get_checksum()) return damaged("its header is");
    const auto wanted = images == 0 ? header.images : static_cast<std::uint64_t>(images);
    if (wanted > header.images) {
        return Error{ErrorCode::kInvalidArgument,
                     path + ": " + std::to_string(header.images) + " pictures, not " +
                         std::to_string(wanted)};
    }

    SyntheticCollection collection;
    collection.seed = header.seed;
    collection.source_digest = header.source_digest;
    for (auto& queries : collection.queries) {
        queries.resize(header.queries);
        if (!in.get(std::span(queries))) return damaged("its queries are");
    }
    if (!in.get_checksum()) return damaged("its queries are");
    const auto read_pictures = std::min<std::uint64_t>(
        header.images, (wanted + kCacheBlock - 1) / kCacheBlock * kCacheBlock);
    collection.signatures.reserve(read_pictures);
    if (with_features) {
        collection.cells.reserve(read_pictures);
        collection.histograms.reserve(read_pictures);
    }
    for (std::uint64_t first = 0; first < wanted; first += kCacheBlock) {
        const std::uint64_t count =
            std::min<std::uint64_t>(kCacheBlock, header.images - first);
        // The whole block, for its checksum; what is too much is cut off at the end.
        collection.signatures.resize(first + count);
        if (!in.get(std::span(collection.signatures).subspan(first)) ||
            !in.get_checksum())
            return damaged("signatures are");
        if (with_features) {
            collection.cells.resize(first + count);
            collection.histograms.resize(first + count);
            if (!in.get(std::span(collection.cells).subspan(first)) ||
                !in.get(std::span(collection.histograms).subspan(first)) ||
                !in.get_checksum()) {
                return damaged("descriptions are");
            }
        } else {
            in.skip(count * (sizeof(CellBytes) + sizeof(HistogramCounts)) + 8);
        }
    }
    collection.signatures.resize(wanted);
    if (with_features) {
        collection.cells.resize(wanted);
        collection.histograms.resize(wanted);
    }
    return collection;
}

}  // namespace

Result<SyntheticCollection> read_signature_cache(const std::string& path) {
    return read(path, 0, false);
}

Result<SyntheticCollection> read_collection_cache(const std::string& path,
                                                  std::int64_t images) {
    assert(images >= 1);
    return read(path, images, true);
}

Result<void> write_collection_cache(const SyntheticCollection& collection,
                                    const std::string& path) {
    const std::string unfinished = path + ".part";
    Writer out(unfinished);
    Header header;
    header.seed = collection.seed;
    header.source_digest = collection.source_digest;
    header.images = collection.signatures.size();
    header.queries = static_cast<std::uint32_t>(collection.queries.front().size());
    out.put(std::span<const Header>(&header, 1));
    out.put_checksum();
    for (const auto& queries : collection.queries) {
        assert(queries.size() == header.queries);
        out.put(std::span(queries));
    }
    out.put_checksum();
    for (std::size_t first = 0; first < header.images; first += kCacheBlock) {
        const std::size_t count =
            std::min<std::size_t>(kCacheBlock, header.images - first);
        out.put(std::span(collection.signatures).subspan(first, count));
        out.put_checksum();
        out.put(std::span(collection.cells).subspan(first, count));
        out.put(std::span(collection.histograms).subspan(first, count));
        out.put_checksum();
    }
    std::error_code failure;
    if (out.finish()) {
        std::filesystem::rename(unfinished, path, failure);
        if (!failure) return {};
    }
    std::filesystem::remove(unfinished, failure);
    return Error{ErrorCode::kIo, path + ": cannot be written"};
}

}  // namespace haarmony::eval
