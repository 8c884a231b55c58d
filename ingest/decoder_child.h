// A process that decodes pictures of the risky formats for us, and may die of one
// (ingest, step 2): the readers of these formats are large, old and written in C; what they
// do wrong must cost one picture, never the service.
//
// The child (haarmony-decode) is started for the first picture, kept for the next ones, and
// replaced when it crashed, hung or talked nonsense. It has limits on memory, processor
// time and files, no descriptor but its socket, and an empty environment.
//
// Units   Raster as the decoder made it: not yet upright.
// Errors  kUndecodable (damaged; its decoder crashed or ran out of time), kTooLarge (pixels
//         or memory), kIo (the child cannot be started; no memory file).
// Threads one DecoderChild a thread; any number of them side by side.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "ingest/decoder_wire.h"
#include "ingest/raster.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

struct ChildOptions {
    std::string program;  // path of haarmony-decode
    std::int64_t address_space = 0;
    int cpu_seconds = 0;                   // for one picture
    std::chrono::milliseconds patience{};  // for one picture, by the clock on the wall
    std::int64_t max_pixels = 0;
};

class DecoderChild {
  public:
    explicit DecoderChild(ChildOptions options);
    ~DecoderChild();
    DecoderChild(const DecoderChild&) = delete;
    DecoderChild& operator=(const DecoderChild&) = delete;

    [[nodiscard]] Result<Raster> decode(Format format,
                                        std::span<const std::uint8_t> bytes);

    // The running child, -1 = none.
    [[nodiscard]] pid_t pid() const { return pid_; }

  private:
    [[nodiscard]] Result<void> start();
    [[nodiscard]] Result<void> request(Format format,
                                       std::span<const std::uint8_t> bytes);
    [[nodiscard]] Result<Raster> receive(Format format);
    [[nodiscard]] Error bury(Format format, const std::string& sign);
    int kill_and_wait();

    ChildOptions options_;
    FileDescriptor socket_;
    pid_t pid_ = -1;
};

// haarmony-decode beside the running executable, or in ../libexec, or just its name where
// neither exists (starting it then fails and says so).
[[nodiscard]] std::string find_decoder_program();

}  // namespace haarmony::ingest
