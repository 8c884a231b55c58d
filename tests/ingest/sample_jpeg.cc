// JPEG files of every kind that the decoder must know, with libjpeg's own writer.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
// jpeglib.h needs size_t and FILE from <cstdio>.
#include <jpeglib.h>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

// A script of exactly `count` scans: DC of all components, then as many refinements of
// single AC coefficients as are needed.
std::vector<jpeg_scan_info> long_script(int components, int count) {
    std::vector<jpeg_scan_info> script;
    jpeg_scan_info dc{};
    dc.comps_in_scan = components;
    for (int c = 0; c < components; ++c) dc.component_index[c] = c;
    script.push_back(dc);
    for (int i = 1; i < count; ++i) {
        jpeg_scan_info ac{};
        ac.comps_in_scan = 1;
        ac.component_index[0] = (i - 1) / 63;
        ac.Ss = ac.Se = 1 + (i - 1) % 63;
        script.push_back(ac);
    }
    return script;
}

}  // namespace

Bytes write_jpeg(const Raster& picture, const JpegFile& file) {
    jpeg_compress_struct codec{};
    jpeg_error_mgr errors{};
    codec.err = jpeg_std_error(&errors);
    jpeg_create_compress(&codec);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = static_cast<JDIMENSION>(picture.width);
    codec.image_height = static_cast<JDIMENSION>(picture.height);
    codec.input_components = picture.channels;
    codec.in_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    if (file.cmyk) codec.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&codec);
    if (file.cmyk && file.ycck) jpeg_set_colorspace(&codec, JCS_YCCK);
    codec.write_Adobe_marker = file.cmyk && file.adobe_marker ? TRUE : FALSE;
    jpeg_set_quality(&codec, file.quality, TRUE);
    if (picture.channels > 1) {
        codec.comp_info[0].h_samp_factor = file.subsampling;
        codec.comp_info[0].v_samp_factor = file.subsampling;
    }
    if (file.progressive) jpeg_simple_progression(&codec);
    const std::vector<jpeg_scan_info> script =
        file.scans > 0 ? long_script(picture.channels, file.scans)
                       : std::vector<jpeg_scan_info>();
    if (!script.empty()) {
        codec.scan_info = script.data();
        codec.num_scans = static_cast<int>(script.size());
    }
    jpeg_start_compress(&codec, TRUE);
    if (!file.exif.empty()) {
        jpeg_write_marker(&codec,
                          JPEG_APP0 + 1,
                          file.exif.data(),
                          static_cast<unsigned>(file.exif.size()));
    }
    const bool invert = file.cmyk && file.adobe_marker;
    for (int y = 0; y < picture.height; ++y) {
        Bytes row(picture.row(y), picture.row(y) + picture.row_bytes());
        if (invert) {
            for (std::uint8_t& ink : row) ink = static_cast<std::uint8_t>(255 - ink);
        }
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&codec, &pointer, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    Bytes result(bytes, bytes + size);
    std::free(bytes);
    return result;
}

}  // namespace haarmony::ingest
