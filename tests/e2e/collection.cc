#include "tests/e2e/collection.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "ingest/thumbnail.h"

namespace haarmony::e2e {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr int kLongestSide = 320;
constexpr std::chrono::seconds kBound{60};

std::vector<std::string> with(std::vector<std::string> first,
                              const std::vector<std::string>& rest) {
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
}

}  // namespace

std::string program(const std::string& name) {
    return std::string(HAARMONY_PROGRAMS) + "/" + name;
}

eval::RgbPicture to_picture(const gallery::Painting& painting) {
    return {painting.width, painting.height, painting.rgb};
}

std::string to_jpeg(const eval::RgbPicture& picture, int quality) {
    const auto bytes = ingest::encode_jpeg(picture.view(), quality);
    if (!bytes) throw std::runtime_error(bytes.error().message);
    return {bytes->begin(), bytes->end()};
}

void write_file(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string picture_name(int number) {
    const std::string digits = std::to_string(number);
    return "picture-" + std::string(3 - digits.size(), '0') + digits + ".jpg";
}

eval::RgbPicture picture(int number) {
    return to_picture(gallery::paint(kSeed, number, kLongestSide));
}

void write_pictures(const std::string& folder, int count) {
    std::filesystem::create_directories(folder);
    for (int number = 0; number < count; ++number) {
        write_file(folder + "/" + picture_name(number), to_jpeg(picture(number)));
    }
}

testing::Finished ingest(const std::string& database,
                         const std::vector<std::string>& arguments) {
    return testing::run(with({program("haarmony-ingest"), "--db", database}, arguments));
}

Daemon::Daemon(const std::string& database, const std::vector<std::string>& arguments)
    : process_(with({program("haarmonyd"), "--db", database, "--listen", "127.0.0.1:0"},
                    arguments)) {
    const std::string expected = "listening on ";
    const auto line = process_.read_line(kBound);
    if (!line || !line->starts_with(expected)) {
        throw std::runtime_error("haarmonyd said: " + line.value_or("nothing") + "\n" +
                                 process_.wait(std::chrono::seconds{1}).err);
    }
    url_ = line->substr(expected.size());
    testing::CurlClient curl(url_);
    const auto end = std::chrono::steady_clock::now() + kBound;
    while (curl.get("/readyz").status != 200) {
        if (std::chrono::steady_clock::now() > end)
            throw std::runtime_error("never ready");
    }
}

testing::Finished Daemon::stop() {
    process_.signal(SIGTERM);
    return process_.wait(kBound);
}

void Daemon::kill_hard() {
    process_.signal(SIGKILL);
    (void)process_.wait(kBound);
}

}  // namespace haarmony::e2e
