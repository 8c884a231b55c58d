#include "engine/curve/chain.h"

#include <cassert>
#include <cmath>

namespace haarmony::curve {

Chain make_chain(const Points& bezier) {
    assert(bezier.size() >= 4 && bezier.size() % 3 == 1);
    const std::size_t count = bezier.size() / 3;
    Chain chain;
    chain.pieces.reserve(count);
    chain.leaving.reserve(count);
    chain.arriving.reserve(count);
    chain.samples.reserve(count * kSamplesPerPiece + 1);
    for (std::size_t k = 0; k < count; ++k) {
        const PlaneCubic piece = cubic_at(bezier, 3 * k);
        const PlanePolynomial polynomial(piece);
        for (std::size_t i = 0; i < kSamplesPerPiece; ++i) {
            chain.samples.push_back(
                polynomial.value(static_cast<double>(i) / kSamplesPerPiece));
        }
        for (const PlaneVector p : piece) {
            chain.size = std::max({chain.size, std::abs(p.x), std::abs(p.y)});
        }
        chain.pieces.push_back(piece);
        chain.leaving.push_back(tangent_at_start(piece));
        chain.arriving.push_back(tangent_at_end(piece));
    }
    chain.samples.push_back(chain.pieces.back()[3]);
    chain.lengths.resize(chain.samples.size());
    for (std::size_t i = 1; i < chain.samples.size(); ++i) {
        chain.lengths[i] =
            chain.lengths[i - 1] + norm(chain.samples[i] - chain.samples[i - 1]);
    }
    return chain;
}

}  // namespace haarmony::curve
