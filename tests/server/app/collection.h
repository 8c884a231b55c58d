// A database of a test's own, pictures to fill it with, and a service that is ready.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/image_view.h"
#include "server/app/image_service.h"
#include "tests/engine/image/pictures.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::server {

// Waits until `holds`, for as long as a loaded machine may need; whether it came true.
[[nodiscard]] bool becomes_true(const std::function<bool()>& holds);

// A JPEG of a scene; another number, another scene.
[[nodiscard]] std::vector<std::uint8_t> jpeg_scene(unsigned number);
// A PNG of 3 (RGB) or 4 (RGBA) channels.
[[nodiscard]] std::vector<std::uint8_t> png_of(const ImageView& picture);

[[nodiscard]] std::string text_of(const std::vector<std::uint8_t>& bytes);

// A row as haarmony-ingest would store it.
[[nodiscard]] schema::NewImage file_row(unsigned number, const std::string& uri);

struct Collection {
    Collection();

    [[nodiscard]] std::string path() const { return folder.file("haarmony.db"); }
    // Opens the service and waits until it is ready.
    void open(int index_m = 60);
    ImageId add(unsigned number, const ImageAttributes& attributes = {});

    schema::ScratchFolder folder;
    std::unique_ptr<ImageService> service;
};

// Another process at the same database, as haarmony-ingest is.
[[nodiscard]] std::unique_ptr<Connection> beside(const Collection& collection);

}  // namespace haarmony::server
