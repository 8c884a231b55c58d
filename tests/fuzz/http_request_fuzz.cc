// Whatever bytes come in, in one piece or in two: the same request, or the same refusal.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "server/http/request_parser.h"

namespace {

using haarmony::http::Request;
using haarmony::http::RequestParser;
using State = RequestParser::State;

void require(bool holds) {
    if (!holds) std::abort();
}

void feed(RequestParser& parser, std::string& received) {
    for (;;) {
        received.erase(0, parser.feed(received));
        if (parser.state() != State::kHeadDone) return;
        parser.begin_body(1'000);
    }
}

void check(std::string_view bytes, std::size_t cut) {
    RequestParser whole;
    std::string received(bytes);
    feed(whole, received);

    RequestParser halves;
    received = bytes.substr(0, cut);
    feed(halves, received);
    received += bytes.substr(cut);
    feed(halves, received);
    // Once it waits for the rest of a head, the parser looks at nothing before the head is
    // whole: it may refuse later what it refused at once, but it must refuse it.
    if (whole.state() == State::kBad && halves.state() == State::kHead) {
        received += "\r\n\r\n";
        feed(halves, received);
    }

    require(whole.state() == halves.state());
    if (whole.state() == State::kBad) {
        require(whole.problem().status >= 400 && whole.problem().status < 506);
        require(whole.problem().status == halves.problem().status);
    }
    const Request& a = whole.request();
    const Request& b = halves.request();
    require(a.method == b.method && a.path == b.path && a.query == b.query);
    if (whole.state() == State::kDone) {
        require(a.body == b.body && a.body.size() <= 1'000);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    if (size == 0) return 0;
    // The first byte says where the pieces part.
    const std::string_view text(reinterpret_cast<const char*>(bytes) + 1, size - 1);
    check(text, bytes[0] * text.size() / 255);
    return 0;
}
