// A folder of generated pictures, and the real executables working on it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ingest/gallery/gallery.h"
#include "tests/eval/degrade.h"
#include "tests/support/curl_client.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::e2e {

// Path of one of our programs, e.g. "haarmonyd".
[[nodiscard]] std::string program(const std::string& name);

[[nodiscard]] eval::RgbPicture to_picture(const gallery::Painting& painting);
[[nodiscard]] std::string to_jpeg(const eval::RgbPicture& picture, int quality = 90);

void write_file(const std::string& path, const std::string& bytes);

// `count` pictures of the gallery as picture-000.jpg, ... in `folder`.
void write_pictures(const std::string& folder, int count);
[[nodiscard]] std::string picture_name(int number);
[[nodiscard]] eval::RgbPicture picture(int number);

// Runs haarmony-ingest with plain output off; further arguments follow the database.
[[nodiscard]] testing::Finished ingest(const std::string& database,
                                       const std::vector<std::string>& arguments);

// haarmonyd on a free port of loopback, ready when the constructor returns.
class Daemon {
  public:
    Daemon(const std::string& database, const std::vector<std::string>& arguments);

    [[nodiscard]] testing::CurlClient client() const { return testing::CurlClient(url_); }
    [[nodiscard]] const std::string& url() const { return url_; }
    // SIGTERM, and what it said.
    testing::Finished stop();
    void kill_hard();

  private:
    testing::Process process_;
    std::string url_;
};

}  // namespace haarmony::e2e
