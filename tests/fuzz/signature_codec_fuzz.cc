// Whatever bytes come in, of every kind: refused with a reason, or a signature whose bytes,
// text and open form are the same again, and which can be mirrored and turned.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

#include "engine/image/signature_codec.h"
#include "engine/image/symmetry.h"

namespace {

using haarmony::Result;
using haarmony::image::Signature;
using haarmony::image::Symmetry;

void require(bool holds) {
    if (!holds) std::abort();
}

// A signature that was accepted stays acceptable in every position, and comes back.
void check_symmetries(const Signature& signature) {
    for (const Symmetry symmetry : haarmony::image::kSymmetries) {
        const Signature moved = haarmony::image::transformed(signature, symmetry);
        require(haarmony::image::decode_signature(encode_signature(moved)).has_value());
        require(transformed(moved, haarmony::image::inverse(symmetry)) == signature);
    }
}

void check(std::span<const std::uint8_t> bytes) {
    const Result<Signature> decoded = haarmony::image::decode_signature(bytes);
    if (!decoded) {
        require(!decoded.error().message.empty());
        return;
    }
    const std::vector<std::uint8_t> again = haarmony::image::encode_signature(*decoded);
    require(std::ranges::equal(again, bytes));
    const auto opened = haarmony::image::from_open(haarmony::image::to_open(*decoded));
    require(opened && opened->kind == decoded->kind);
    require(opened->channels == decoded->channels);
    check_symmetries(*decoded);
}

void check_text(std::string_view text) {
    const Result<Signature> decoded = haarmony::image::signature_from_text(text);
    if (decoded) require(haarmony::image::signature_to_text(*decoded) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    check({bytes, size});
    check_text({reinterpret_cast<const char*>(bytes), size});
    return 0;
}
