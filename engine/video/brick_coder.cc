#include "engine/video/brick_coder.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

namespace haarmony::video {
namespace {

// What is no further off than this, over all channels of 64 pixels, is good enough.
constexpr std::uint32_t kNear = 128;

// In the order in which they are tried: the cheap ones first.
constexpr std::array<Reference, BrickEncoder::kTried> kTried = {Reference::kMirror,
                                                                Reference::kOtherEdge,
                                                                Reference::kParent,
                                                                Reference::kParentCoarse,
                                                                Reference::kCoarse};

// The prediction that is nearest to the brick.
class Choice {
  public:
    Choice(const Brick& brick,
           const BrickNeighbors& neighbors,
           std::array<PredictionRoom, kTried.size()>& rooms) {
        for (std::size_t i = 0; i < kTried.size() && least_ > kNear; ++i) {
            if (!possible(kTried[i], neighbors)) continue;
            const Brick& made = predict(kTried[i], neighbors, rooms[i]);
            const std::uint32_t off = deviation(brick, made);
            if (off >= least_) continue;
            least_ = off;
            predicted_ = &made;
            reference_ = kTried[i];
        }
        if (predicted_ == nullptr)
            predicted_ = &predict(Reference::kBefore, neighbors, rooms[0]);
    }

    [[nodiscard]] Reference reference() const { return reference_; }
    [[nodiscard]] const Brick& predicted() const { return *predicted_; }

  private:
    Reference reference_ = Reference::kBefore;
    std::uint32_t least_ = std::numeric_limits<std::uint32_t>::max();
    const Brick* predicted_ = nullptr;
};

}  // namespace

void BrickEncoder::put(const Brick& brick, const BrickNeighbors& around) {
    assert(std::all_of(brick.begin(), brick.end(), [](Rgba pixel) {
        return canonical(pixel) == pixel;
    }));
    BrickNeighbors neighbors = around;
    neighbors.before = &before_;
    const Choice choice(brick, neighbors, rooms_);
    PackedRows rows;
    const Left left = pack_residuals(brick, choice.predicted(), rows);
    const bool alpha = !left.opaque && left.alpha;
    BrickMode mode;
    mode.reference = choice.reference();
    mode.alpha = left.opaque  ? AlphaMode::kOpaque
                 : left.alpha ? AlphaMode::kCoded
                              : AlphaMode::kAsPredicted;
    mode.exact = !left.colors && !alpha;
    mode.follows_green = left.follows_green && !mode.exact;
    modes_.push_back(mode.symbol());
    if (!mode.exact) rows_.put(rows, alpha);
    before_ = brick;
}

void BrickEncoder::finish(std::vector<std::byte>& out) const {
    put_stream(modes_, Redundancy::kRepeated, out);
    rows_.finish(out);
}

Result<BrickDecoder> BrickDecoder::open(StreamReader& reader, std::uint64_t bricks) {
    Result<Stream> modes = reader.next(bricks);
    if (!modes) return std::move(modes).error();
    if ((*modes).size() != bricks) {
        return Error{ErrorCode::kUndecodable,
                     std::to_string((*modes).size()) + " modes for " +
                         std::to_string(bricks) + " bricks"};
    }
    Result<RowReader> rows = RowReader::open(reader, bricks);
    if (!rows) return std::move(rows).error();
    return BrickDecoder(*std::move(modes), *std::move(rows));
}

std::uint8_t BrickDecoder::next_symbol() {
    assert(next_mode_ < modes_.size());
    return modes_[next_mode_++];
}

Result<void> BrickDecoder::next(std::uint8_t symbol,
                                const BrickNeighbors& around,
                                Brick& brick) {
    BrickNeighbors neighbors = around;
    neighbors.before = &before_;
    const BrickMode mode = mode_of(symbol % kModeSymbols);
    if (!is_mode(symbol) || !possible(mode.reference, neighbors))
        return Error{ErrorCode::kUndecodable, "mode " + std::to_string(symbol)};
    const Brick& predicted = predict(mode.reference, neighbors, room_);
    const bool alpha = mode.alpha == AlphaMode::kCoded;
    if (mode.exact) {
        residuals_.fill(0);
    } else {
        if (!alpha) std::fill(residuals_.begin() + 3 * kBrickPixels, residuals_.end(), 0);
        rows_.next(alpha, residuals_);
    }
    add_residuals(residuals_,
                  predicted,
                  mode.follows_green,
                  mode.alpha == AlphaMode::kOpaque,
                  brick);
    before_ = brick;
    return {};
}

}  // namespace haarmony::video
