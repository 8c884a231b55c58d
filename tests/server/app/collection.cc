#include "tests/server/app/collection.h"

#include <zlib.h>

#include <stdexcept>
#include <thread>
#include <utility>

#include "ingest/describe.h"
#include "ingest/thumbnail.h"

namespace haarmony::server {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::chrono::seconds kPatience{30};
constexpr std::chrono::milliseconds kPause{2};

template <typename T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(result).value();
}

void append_number(Bytes& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

void append_chunk(Bytes& png, const std::string& name, const Bytes& content) {
    append_number(png, static_cast<std::uint32_t>(content.size()));
    Bytes checked(name.begin(), name.end());
    checked.insert(checked.end(), content.begin(), content.end());
    png.insert(png.end(), checked.begin(), checked.end());
    append_number(png,
                  static_cast<std::uint32_t>(
                      crc32(0, checked.data(), static_cast<uInt>(checked.size()))));
}

}  // namespace

bool becomes_true(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

Bytes jpeg_scene(unsigned number) {
    const image::Pixels pixels = image::scene(96, 64, number);
    return must(ingest::encode_jpeg(pixels.view(), 90));
}

Bytes png_of(const ImageView& picture) {
    Bytes rows;
    for (int y = 0; y < picture.height; ++y) {
        rows.push_back(0);  // no filter
        const std::uint8_t* row = picture.row(y);
        rows.insert(rows.end(), row, row + picture.width * picture.channels);
    }
    uLongf size = compressBound(rows.size());
    Bytes packed(size);
    compress(packed.data(), &size, rows.data(), rows.size());
    packed.resize(size);

    Bytes header;
    append_number(header, static_cast<std::uint32_t>(picture.width));
    append_number(header, static_cast<std::uint32_t>(picture.height));
    const std::uint8_t color_type = picture.channels == 4 ? 6 : 2;
    for (const std::uint8_t byte : {std::uint8_t{8}, color_type}) header.push_back(byte);
    header.insert(header.end(), 3, 0);  // deflate, adaptive filters, no interlace
    Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    append_chunk(png, "IHDR", header);
    append_chunk(png, "IDAT", packed);
    append_chunk(png, "IEND", {});
    return png;
}

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

schema::NewImage file_row(unsigned number, const std::string& uri) {
    ingest::Decoder decoder{ingest::DecodeLimits{}};
    schema::NewImage row =
        must(ingest::describe(decoder, jpeg_scene(number), ingest::kMainKind));
    row.origin = schema::ImageOrigin::kFile;
    row.uri = uri;
    return row;
}

Collection::Collection() {
    must(schema::Database::open(path(), schema::Database::Mode::kReadWriteCreate));
}

void Collection::open(int index_m) {
    ImageServiceOptions options;
    options.database_path = path();
    options.index_m = index_m;
    options.poll_interval = std::chrono::milliseconds(1);
    service = must(ImageService::open(options));
    if (!becomes_true([this] { return service->ready(); }))
        throw std::runtime_error("the service does not get ready");
}

ImageId Collection::add(unsigned number, const ImageAttributes& attributes) {
    return must(service->add(jpeg_scene(number), attributes));
}

std::unique_ptr<Connection> beside(const Collection& collection) {
    return must(
        Connection::open(collection.path(), schema::Database::Mode::kReadWriteCreate));
}

}  // namespace haarmony::server
