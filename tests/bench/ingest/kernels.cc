#include "tests/bench/ingest/kernels.h"

#include <memory>
#include <utility>

#include "engine/image/autocrop.h"
#include "engine/image/color_space.h"
#include "engine/image/haar.h"
#include "engine/image/resample.h"
#include "engine/image/signature.h"
#include "engine/image/truncation.h"
#include "ingest/decode.h"
#include "ingest/describe.h"
#include "ingest/thumbnail.h"

namespace haarmony::bench {
namespace {

ingest::Picture decoded(ingest::Decoder& decoder, const JpegFile& file) {
    auto picture = decoder.decode(file.bytes);
    if (!picture) give_up(file.name + ": " + picture.error().message);
    return std::move(picture).value();
}

}  // namespace

std::vector<Contender> stages(const std::vector<JpegFile>& files) {
    const auto decoder = std::make_shared<ingest::Decoder>(ingest::DecodeLimits{});
    const auto pictures = std::make_shared<std::vector<ingest::Picture>>();
    for (const JpegFile& file : files) pictures->push_back(decoded(*decoder, file));
    const auto planes = std::make_shared<image::ColorPlanes>();
    return {{"decode",
             [&files, decoder](std::size_t i) {
                 static_cast<void>(decoded(*decoder, files[i]));
             }},
            {"thumbnail",
             [pictures](std::size_t i) {
                 static_cast<void>(ingest::make_thumbnail((*pictures)[i].view()));
             }},
            {"area average",
             [pictures, planes](std::size_t i) {
                 static_cast<void>(image::area_average((*pictures)[i].view(), *planes));
             }},
            {"signature, area average in it",
             [pictures](std::size_t i) {
                 static_cast<void>(image::make_signature((*pictures)[i].view()));
             }},
            {"borders looked for",
             [pictures](std::size_t i) {
                 static_cast<void>(image::content_box((*pictures)[i].view()));
             }},
            {"SHA-256", [&files](std::size_t i) {
                 static_cast<void>(ingest::content_hash(files[i].bytes));
             }}};
}

std::vector<image::ColorPlanes> cells_of(std::span<const JpegFile> files) {
    ingest::Decoder decoder(ingest::DecodeLimits{});
    std::vector<image::ColorPlanes> cells(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        static_cast<void>(
            image::area_average(decoded(decoder, files[i]).view(), cells[i]));
    }
    return cells;
}

std::vector<Contender> kernel_steps(const std::vector<image::ColorPlanes>& cells) {
    const auto planes = std::make_shared<image::ColorPlanes>();
    const auto signature = std::make_shared<image::Signature>();
    const auto copy = [&cells, planes](std::size_t i) { *planes = cells[i]; };
    const auto color = [copy, planes](std::size_t i) {
        copy(i);
        image::convert(image::ColorSpace::kYiq, *planes);
    };
    const auto haar = [color, planes](std::size_t i) {
        color(i);
        for (image::Plane& plane : *planes) {
            image::decompose(plane, image::kSide, image::Decomposition::kStandard);
        }
    };
    const auto all = [haar, planes, signature](std::size_t i) {
        haar(i);
        for (int c = 0; c < image::kChannels; ++c) {
            signature->channels[c] = image::truncate((*planes)[c]);
        }
    };
    return {{"copy, YIQ, Haar, 100 largest", all},
            {"copy, YIQ, Haar", haar},
            {"copy, YIQ", color},
            {"copy of the cells", copy}};
}

}  // namespace haarmony::bench
