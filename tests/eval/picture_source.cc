#include "tests/eval/picture_source.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ingest/decode.h"

namespace haarmony::eval {

namespace fs = std::filesystem;

Result<PictureSource> folder_source(const std::string& folder) {
    PictureSource source;
    std::error_code failure;
    for (fs::recursive_directory_iterator it(folder, failure), end; !failure && it != end;
         it.increment(failure)) {
        if (it->is_regular_file(failure)) {
            source.names.push_back(it->path().lexically_relative(folder).string());
        }
    }
    if (failure) return Error{ErrorCode::kNotFound, folder + ": " + failure.message()};
    std::ranges::sort(source.names);
    source.load = [folder, names = source.names](std::size_t i) -> Result<RgbPicture> {
        const std::string path = (fs::path(folder) / names[i]).string();
        std::ifstream file(path, std::ios::binary);
        const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file),
                                              std::istreambuf_iterator<char>()};
        if (!file) return Error{ErrorCode::kIo, path + ": cannot be read"};
        ingest::Decoder decoder{ingest::DecodeLimits{}};
        const Result<ingest::Picture> picture = decoder.decode(bytes);
        if (!picture) {
            return Error{picture.error().code, path + ": " + picture.error().message};
        }
        return to_rgb(picture->view());
    };
    return source;
}

}  // namespace haarmony::eval
