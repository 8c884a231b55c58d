#include "ingest/picture_sequence.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "ingest/byte_budget.h"
#include "ingest/read_file.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {
namespace {

constexpr std::int64_t kMicroseconds = 1'000'000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits from `at` on, without leading zeros; `at` moves behind them.
std::string_view number_at(std::string_view name, std::size_t& at) {
    while (at < name.size() && name[at] == '0') ++at;
    const std::size_t begin = at;
    while (at < name.size() && is_digit(name[at])) ++at;
    return name.substr(begin, at - begin);
}

bool comes_before(std::string_view a, std::string_view b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (is_digit(a[i]) && is_digit(b[j])) {
            const std::string_view m = number_at(a, i);
            const std::string_view n = number_at(b, j);
            if (m.size() != n.size()) return m.size() < n.size();
            if (m != n) return m < n;
        } else if (a[i] != b[j]) {
            return a[i] < b[j];
        } else {
            ++i;
            ++j;
        }
    }
    // Of names that differ in leading zeros alone (1.png, 01.png) the order must be some.
    if (i == a.size() && j == b.size()) return a < b;
    return i == a.size();
}

video::Picture rgba_of(const Picture& decoded) {
    const ImageView view = decoded.view();
    video::Picture picture(view.width, view.height);
    for (std::int32_t y = 0; y < view.height; ++y) {
        const std::uint8_t* row = view.row(y);
        for (std::int32_t x = 0; x < view.width; ++x) {
            const std::uint8_t* sample = row + std::ptrdiff_t{x} * view.channels;
            const bool grey = view.channels == 1;
            picture.at(x, y) =
                video::canonical({sample[0],
                                  grey ? sample[0] : sample[1],
                                  grey ? sample[0] : sample[2],
                                  view.channels == 4 ? sample[3] : std::uint8_t{255}});
        }
    }
    return picture;
}

class PictureSequence : public PictureSource {
  public:
    explicit PictureSequence(PictureSequenceOptions options)
        : options_(std::move(options)),
          decoder_(options_.limits),
          budget_(options_.max_file_bytes) {}

    [[nodiscard]] Result<void> open();
    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(TimedPicture& shown) override;

  private:
    [[nodiscard]] Result<video::Picture> decode(const std::string& file);

    PictureSequenceOptions options_;
    Decoder decoder_;
    ByteBudget budget_;
    video::FrameFormat format_;
    video::Picture first_;
    std::size_t shown_ = 0;
};

Result<video::Picture> PictureSequence::decode(const std::string& file) {
    const std::string name = std::filesystem::path(file).filename().string();
    const auto in_file = [&name](Error error) {
        error.message = name + ": " + error.message;
        return error;
    };
    ReadLimits limits;
    limits.max_bytes = options_.max_file_bytes;
    const Result<FileContent> content = read_file(file, limits, budget_);
    if (!content) return in_file(content.error());
    const Result<Picture> decoded = decoder_.decode(content->bytes);
    if (!decoded) return in_file(decoded.error());
    return rgba_of(*decoded);
}

Result<void> PictureSequence::open() {
    if (options_.files.empty()) {
        return Error{ErrorCode::kInvalidArgument, "a sequence of no pictures", "files"};
    }
    Result<video::Picture> first = decode(options_.files.front());
    if (!first) return first.error();
    first_ = std::move(first).value();
    format_ = {first_.width, first_.height, options_.rate};
    const auto shape =
        video::ClipShape::make(format_, static_cast<std::int64_t>(options_.files.size()));
    return shape ? Result<void>() : shape.error();
}

Result<bool> PictureSequence::next(TimedPicture& shown) {
    if (shown_ == options_.files.size()) return false;
    if (shown_ == 0) {
        shown.picture = std::move(first_);
    } else {
        const std::string& file = options_.files[shown_];
        Result<video::Picture> picture = decode(file);
        if (!picture) return picture.error();
        if (picture->width != format_.width || picture->height != format_.height) {
            return Error{ErrorCode::kInvalidArgument,
                         std::filesystem::path(file).filename().string() + " is " +
                             std::to_string(picture->width) + " x " +
                             std::to_string(picture->height) +
                             " pixels, the pictures before are " +
                             std::to_string(format_.width) + " x " +
                             std::to_string(format_.height)};
        }
        shown.picture = std::move(picture).value();
    }
    shown.time_us = static_cast<std::int64_t>(shown_) * kMicroseconds *
                    format_.rate.denominator / format_.rate.numerator;
    ++shown_;
    return true;
}

}  // namespace

Result<std::unique_ptr<PictureSource>> open_picture_sequence(
    PictureSequenceOptions options) {
    options.limits.min_side = video::kMaxSide;  // no JPEG is made smaller
    auto sequence = std::make_unique<PictureSequence>(std::move(options));
    if (auto opened = sequence->open(); !opened) return opened.error();
    return std::unique_ptr<PictureSource>(std::move(sequence));
}

Result<std::vector<std::string>> pictures_in(const std::string& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    std::filesystem::directory_iterator entry(folder, failed);
    for (; !failed && entry != std::filesystem::directory_iterator();
         entry.increment(failed)) {
        const std::string name = entry->path().filename().string();
        std::error_code unknown;
        if (has_picture_extension(name) && entry->is_regular_file(unknown)) {
            names.push_back(name);
        }
    }
    if (failed) {
        const bool gone = failed == std::errc::no_such_file_or_directory ||
                          failed == std::errc::not_a_directory;
        return Error{gone ? ErrorCode::kNotFound : ErrorCode::kIo,
                     "the folder of pictures: " + failed.message()};
    }
    std::sort(names.begin(), names.end(), comes_before);
    for (std::string& name : names) {
        name = (std::filesystem::path(folder) / name).string();
    }
    return names;
}

}  // namespace haarmony::ingest
