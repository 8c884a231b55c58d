#include "tests/bench/ingest/contenders.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "engine/image/signature.h"
#include "ingest/describe.h"
#include "ingest/thumbnail.h"
#include "tests/bench/ingest/vips_thumbnail.h"

namespace haarmony::bench {
namespace {

void describe_all(ingest::Decoder& decoder, const JpegFile& file) {
    const auto image = ingest::describe(decoder, file.bytes, ingest::kMainKind);
    if (!image) give_up(file.name + ": " + image.error().message);
}

void sign_and_shrink(ingest::Decoder& decoder, const JpegFile& file) {
    const auto picture = decoder.decode(file.bytes);
    if (!picture) give_up(file.name + ": " + picture.error().message);
    const auto thumbnail = ingest::make_thumbnail(picture->view());
    if (!thumbnail) give_up(file.name + ": " + thumbnail.error().message);
    static_cast<void>(ingest::signature_variants(picture->view(), ingest::kMainKind));
}

// Every pixel with OpenImageIO, then the signature.
void sign_with_openimageio(const JpegFile& file) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("jpeg");
    // The proxy only reads; its constructor predates const.
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(file.bytes.data()),
                                         file.bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec wish;
    wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    OIIO::ImageSpec spec;
    if (!input || !input->open("picture.jpg", spec, wish)) {
        give_up(file.name + ": " + OIIO::geterror());
    }
    Bytes pixels(spec.image_bytes());
    if (!input->read_image(
            0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) {
        give_up(file.name + ": " + input->geterror());
    }
    static_cast<void>(
        image::make_signature(ImageView{pixels.data(),
                                        spec.width,
                                        spec.height,
                                        spec.nchannels,
                                        std::ptrdiff_t{spec.width} * spec.nchannels}));
}

}  // namespace

void give_up(const std::string& message) {
    std::fprintf(stderr, "haarmony-bench-ingest: %s\n", message.c_str());
    std::exit(3);
}

std::vector<JpegFile> read_folder(const std::string& folder, std::size_t most) {
    std::vector<std::filesystem::path> paths;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        std::string extension = entry.path().extension();
        std::ranges::transform(extension, extension.begin(), [](unsigned char c) {
            return std::tolower(c);
        });
        if (extension == ".jpg" || extension == ".jpeg") paths.push_back(entry.path());
    }
    if (error) give_up(folder + ": " + error.message());
    if (paths.empty()) give_up(folder + ": no JPEG is in it");
    std::ranges::sort(paths);
    const std::size_t count = std::min(most, paths.size());
    std::vector<JpegFile> files;
    for (std::size_t i = 0; i < count; ++i) {
        const std::filesystem::path& path = paths[i * paths.size() / count];
        std::ifstream stream(path, std::ios::binary);
        files.push_back(
            {path.filename(), Bytes(std::istreambuf_iterator<char>(stream), {})});
    }
    return files;
}

std::vector<Contender> contenders(const std::vector<JpegFile>& files) {
    OIIO::attribute("threads", 1);
    const auto decoder = std::make_shared<ingest::Decoder>(ingest::DecodeLimits{});
    std::vector<Contender> result = {
        {"haarmony: signature, thumbnail",
         [&files, decoder](std::size_t i) { sign_and_shrink(*decoder, files[i]); }},
        {"haarmony: signature, thumbnail, SHA-256",
         [&files, decoder](std::size_t i) { describe_all(*decoder, files[i]); }},
        {"OpenImageIO, all pixels: signature",
         [&files](std::size_t i) { sign_with_openimageio(files[i]); }}};
    if (start_vips()) {
        result.push_back(
            {"libvips thumbnail to 128 x 128: signature", [&files](std::size_t i) {
                 const std::string error = sign_with_vips_thumbnail(files[i].bytes);
                 if (!error.empty()) give_up(files[i].name + ": " + error);
             }});
    }
    return result;
}

}  // namespace haarmony::bench
