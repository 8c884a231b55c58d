// Films of our own: the beginning of a Flash video, and then the times of its key frames in
// milliseconds. "FLV\1 0 2000" has two; one with a word that is no number is damaged.
#pragma once

#include <unistd.h>

#include <array>
#include <atomic>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/ingest/pretended_pictures.h"

namespace haarmony::ingest {

[[nodiscard]] inline std::string film_of(const std::string& times) {
    return "FLV\x01 " + times;
}

struct PretendedFilms {
    PretendedPictures pictures;
    std::atomic<int> described = 0;
    std::atomic<int> hashed = 0;
    std::function<void(const std::string& content)> while_describing =
        [](const std::string&) {};

    MakePictureSteps steps() {
        return [this, make = pictures.steps()] {
            PictureSteps steps = make();
            steps.film.describe = [this](int file, const KeepGoing& keep_going) {
                return describe(file, keep_going);
            };
            steps.film.content_hash = [this](int file,
                                             const KeepGoing&) -> Result<std::string> {
                ++hashed;
                const std::string content = content_of(file);
                if (content.find("unreadable") != std::string::npos)
                    return Error{ErrorCode::kIo, "forced failure of reading"};
                return content;
            };
            return steps;
        };
    }

  private:
    static std::string content_of(int file) {
        std::array<char, 4096> bytes{};
        const ssize_t count = ::pread(file, bytes.data(), bytes.size(), 0);
        return {bytes.data(), static_cast<std::size_t>(count)};
    }
    Result<std::vector<KeyFrame>> describe(int file, const KeepGoing& keep_going) {
        ++described;
        const std::string content = content_of(file);
        while_describing(content);
        if (content.find("no child") != std::string::npos)
            return Error{ErrorCode::kIo, "haarmony-video cannot be started"};
        std::vector<KeyFrame> frames;
        std::istringstream words(content.substr(film_of("").size()));
        for (std::string word; words >> word;) {
            if (!keep_going()) return Error{ErrorCode::kUnavailable, "was stopped"};
            if (word.find_first_not_of("0123456789") != std::string::npos)
                return Error{ErrorCode::kUndecodable, "damaged: " + word};
            KeyFrame frame;
            frame.time_us = std::stoll(word) * 1'000;
            frame.number = std::stoll(word) / 40;
            frame.image.width = 16;
            frame.image.signature = {1};
            frames.push_back(std::move(frame));
        }
        return frames;
    }
};

}  // namespace haarmony::ingest
