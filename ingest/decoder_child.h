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

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "ingest/decoder_wire.h"
#include "ingest/raster.h"
#include "ingest/sniff.h"
#include "ingest/socket_child.h"

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

    [[nodiscard]] Result<Raster> decode(Format format,
                                        std::span<const std::uint8_t> bytes);

    // The running child, -1 = none.
    [[nodiscard]] pid_t pid() const { return child_.pid(); }

  private:
    [[nodiscard]] Result<void> request(Format format,
                                       std::span<const std::uint8_t> bytes);
    [[nodiscard]] Result<Raster> receive(Format format);
    [[nodiscard]] Error bury(Format format, const std::string& sign);

    ChildOptions options_;
    SocketChild child_;
};

// As find_program(): haarmony-decode.
[[nodiscard]] std::string find_decoder_program();

}  // namespace haarmony::ingest
