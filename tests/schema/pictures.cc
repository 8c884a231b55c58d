#include "tests/schema/pictures.h"

#include <random>
#include <stdexcept>

namespace haarmony::schema {

std::vector<std::uint8_t> some_bytes(int number, std::size_t count) {
    std::minstd_rand random(static_cast<unsigned>(number) + 1);
    std::vector<std::uint8_t> bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 8);
    return bytes;
}

NewImage file_picture(int number) {
    const std::string name = std::to_string(number);
    NewImage image;
    image.origin = ImageOrigin::kFile;
    image.uri = "file:///photos/" + name + ".jpg";
    image.stamp = {1000 + number, 1'700'000'000'000'000'000 + number, "hash" + name};
    image.width = 640 + number;
    image.height = 480 + number;
    image.media_type = "image/jpeg";
    image.signature = some_bytes(number, 600);
    image.low_information = number % 2 == 1;
    image.thumbnail = {"image/webp", some_bytes(number + 1'000'000, 2000)};
    image.tags = {"tag" + std::to_string(number % 3), "all"};
    image.metadata = R"({"number":)" + name + "}";
    return image;
}

NewImage upload_picture(int number) {
    NewImage image = file_picture(number);
    image.origin = ImageOrigin::kUpload;
    image.uri = "upload-" + std::to_string(number);
    return image;
}

void unexpected(const Error& error) { throw std::runtime_error(error.message); }

void expect(Result<void> result) {
    if (!result) unexpected(result.error());
}

Database open_database(const std::string& path) {
    return expect(Database::open(path, Database::Mode::kReadWriteCreate));
}

}  // namespace haarmony::schema
