#include "engine/video/brick_prediction.h"

#include <cassert>

namespace haarmony::video {
namespace {

// Green, red, blue.
constexpr std::array<std::uint8_t, 3> values_of(Rgba pixel) {
    return {pixel.g, pixel.r, pixel.b};
}

// Pixel of a coarse brick that shows square i of 16 of one of its quadrants.
constexpr int coarse_pixel(int quadrant, int square) {
    return ((quadrant >> 1) * 4 + (square >> 2)) * kBrickSide + (quadrant & 1) * 4 +
           (square & 3);
}
constexpr int square_of(int pixel) {
    return (pixel / kBrickSide >> 1) * 4 + (pixel % kBrickSide >> 1);
}

void base_from(const Brick& brick, Prediction& prediction) {
    for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
        const auto values = values_of(brick[pixel]);
        for (int plane = 0; plane < kPlanes; ++plane)
            prediction.base[plane][pixel] = values[plane];
        prediction.alpha[pixel] = brick[pixel].a;
    }
}

void mirror_base(const Brick& parent, const Brick& first, Prediction& prediction) {
    for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
        const auto mean = values_of(parent[pixel]);
        const auto half = values_of(first[pixel]);
        for (int plane = 0; plane < kPlanes; ++plane) {
            prediction.base[plane][pixel] =
                static_cast<std::int16_t>(clamped(2 * mean[plane] - half[plane]));
            prediction.first_off_parent[plane][pixel] =
                static_cast<std::int16_t>(half[plane] - mean[plane]);
        }
        prediction.alpha[pixel] = parent[pixel].a;
    }
}

void add_coarse(const Brick& brick, int quadrant, int sign, Prediction& prediction) {
    for (int square = 0; square < 16; ++square) {
        const auto values = values_of(brick[coarse_pixel(quadrant, square)]);
        for (int plane = 0; plane < kPlanes; ++plane) {
            std::int16_t& sum = prediction.coarse[plane][square];
            sum = static_cast<std::int16_t>(sum + sign * values[plane]);
        }
    }
}

void borders_from(const BrickNeighbors& neighbors, Prediction& prediction) {
    prediction.has_left = neighbors.left != nullptr;
    prediction.has_above = neighbors.above != nullptr;
    for (int i = 0; i < kBrickSide; ++i) {
        if (prediction.has_left) {
            const auto values =
                values_of((*neighbors.left)[i * kBrickSide + kBrickSide - 1]);
            for (int plane = 0; plane < kPlanes; ++plane)
                prediction.left[plane][i] = values[plane];
        }
        if (prediction.has_above) {
            const auto values =
                values_of((*neighbors.above)[(kBrickSide - 1) * kBrickSide + i]);
            for (int plane = 0; plane < kPlanes; ++plane)
                prediction.above[plane][i] = values[plane];
        }
    }
}

}  // namespace

bool possible(const BrickMode& mode, const BrickNeighbors& neighbors) {
    const bool coarse = mode.reference == Reference::kCoarse ||
                        mode.reference == Reference::kParentCoarse;
    if (mode.predictor == Predictor::kQuad && !coarse) return false;
    if (mode.predictor == Predictor::kMedian && coarse) return false;
    switch (mode.reference) {
        case Reference::kNone:
            return true;
        case Reference::kParent:
            return neighbors.parent != nullptr;
        case Reference::kMirror:
            return neighbors.parent != nullptr && neighbors.first != nullptr;
        case Reference::kCoarse:
            return neighbors.coarse != nullptr;
        case Reference::kParentCoarse:
            return neighbors.parent != nullptr && neighbors.coarse != nullptr &&
                   neighbors.parent_coarse != nullptr;
        case Reference::kOtherEdge:
            return neighbors.other_edge != nullptr;
    }
    return false;
}

void predict(const BrickMode& mode,
             const BrickNeighbors& neighbors,
             Prediction& prediction) {
    assert(possible(mode, neighbors));
    prediction.has_left = prediction.has_above = false;
    prediction.first = 0;
    for (auto& plane : prediction.coarse) plane.fill(0);
    switch (mode.reference) {
        case Reference::kNone:
            for (Plane& plane : prediction.base) plane.fill(0);
            prediction.alpha.fill(0);
            prediction.first = 128;
            borders_from(neighbors, prediction);
            break;
        case Reference::kParent:
            base_from(*neighbors.parent, prediction);
            break;
        case Reference::kMirror:
            mirror_base(*neighbors.parent, *neighbors.first, prediction);
            break;
        case Reference::kCoarse:
            for (Plane& plane : prediction.base) plane.fill(0);
            for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
                prediction.alpha[pixel] =
                    (*neighbors
                          .coarse)[coarse_pixel(neighbors.quadrant, square_of(pixel))]
                        .a;
            }
            add_coarse(*neighbors.coarse, neighbors.quadrant, 1, prediction);
            borders_from(neighbors, prediction);
            break;
        case Reference::kParentCoarse:
            base_from(*neighbors.parent, prediction);
            add_coarse(*neighbors.coarse, neighbors.quadrant, 1, prediction);
            add_coarse(*neighbors.parent_coarse, neighbors.quadrant, -1, prediction);
            break;
        case Reference::kOtherEdge:
            base_from(*neighbors.other_edge, prediction);
            break;
    }
}

}  // namespace haarmony::video
