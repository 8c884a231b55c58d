#include "tests/engine/video/random_links.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <random>

#include "engine/video/mrv_format.h"
#include "engine/video/mrv_writer.h"

namespace haarmony::video::testing {
namespace {

class Maker {
  public:
    Maker(const ClipShape& shape, std::uint32_t seed)
        : shape_(shape),
          levels_(static_cast<std::size_t>(std::max(shape.space_levels(), kBrickLevel) -
                                           kBrickLevel + 1)),
          random_(seed) {}

    std::vector<Siblings> make() {
        add({0, 0});
        return std::move(made_);
    }

  private:
    std::uint32_t below(std::size_t end) {
        return static_cast<std::uint32_t>(random_() % end);
    }

    // Any ref to one of counts[k] things of time level k, or none.
    Ref any(const std::vector<std::size_t>& counts) {
        std::vector<Ref> some;
        for (std::size_t k = 0; k < counts.size(); ++k) {
            if (counts[k] > 0)
                some.push_back(make_ref(static_cast<int>(k), below(counts[k])));
        }
        return some.empty() ? kNoDetailRef : some[below(some.size())];
    }

    Brick brick() {
        const Rgba color{static_cast<std::uint8_t>(random_()),
                         static_cast<std::uint8_t>(random_()),
                         static_cast<std::uint8_t>(random_()),
                         255};
        const std::uint32_t kind = below(5);
        Brick made;
        for (int i = 0; i < kBrickPixels; ++i) {
            Rgba pixel = color;
            const auto bits = static_cast<std::uint32_t>(random_());
            if (kind == 1) pixel.r = static_cast<std::uint8_t>(pixel.r + i / 8);
            if (kind >= 2) {
                pixel = {static_cast<std::uint8_t>(bits),
                         static_cast<std::uint8_t>(bits >> 8),
                         static_cast<std::uint8_t>(bits >> 16),
                         255};
            }
            if (kind >= 3)
                pixel.a = static_cast<std::uint8_t>(i % 3 == 0 ? 0 : bits >> 24);
            if (kind == 4) pixel = kClear;
            made[static_cast<std::size_t>(i)] = canonical(pixel);
        }
        return made;
    }
    // Like another brick of the chain, but for a little.
    Brick similar_brick(std::size_t level) {
        const Siblings& other = chain_[below(chain_.size())];
        if (other.layers[level].bricks.empty()) return brick();
        Brick made = other.layers[level].bricks[below(other.layers[level].bricks.size())];
        for (Rgba& pixel : made) {
            if (below(4) == 0) pixel.g = static_cast<std::uint8_t>(pixel.g + below(3));
            pixel = canonical(pixel);
        }
        return made;
    }

    void add(const SiblingAddress& address) {
        const auto k = static_cast<std::size_t>(address.time_level);
        chain_.resize(k);
        Siblings& own = chain_.emplace_back();
        own.address = address;
        own.layers.resize(levels_);
        for (std::size_t level = 0; level < levels_; ++level) {
            const std::size_t least = k == 0 ? 1 : 0;
            own.layers[level].nodes.resize(least + below(level == 0 ? 3 : 9));
            for (std::size_t i = least + below(6); i > 0; --i)
                own.layers[level].bricks.push_back(below(2) == 0 ? brick()
                                                                 : similar_brick(level));
        }
        const auto counts = [this](std::size_t level, bool nodes) {
            std::vector<std::size_t> made;
            for (const Siblings& siblings : chain_) {
                const Layer& layer = siblings.layers[level];
                made.push_back(nodes ? layer.nodes.size() : layer.bricks.size());
            }
            return made;
        };
        for (std::size_t level = 0; level < levels_; ++level) {
            LinkedNodes& nodes = own.layers[level].nodes;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                LinkedNode& node = nodes[i];
                node.brick = any(counts(level, false));
                for (Ref& child : node.child) {
                    if (level + 1 < levels_ && below(4) != 0)
                        child = any(counts(level + 1, true));
                }
            }
        }
        const int halves = k == 0 ? 1
                           : shape_.contains({address.time_level, 2 * address.index + 1})
                               ? 2
                               : 1;
        own.nodes.count = halves;
        for (int half = 0; half < halves; ++half) {
            TimeNode& node = own.nodes.node[static_cast<std::size_t>(half)];
            for (Ref& root : node.root) root = any(counts(0, true));
            if (below(3) == 0) node.root[1] = node.root[0];
            for (Apex& apex : node.apex) {
                for (Rgba& pixel : apex) pixel = brick()[0];
            }
            node.bounds = {0,
                           0,
                           shape_.width(),
                           static_cast<std::int32_t>(below(shape_.height() + 1))};
        }
        made_.push_back(own);
        if (address.time_level == shape_.time_levels()) return;
        for (int half = 0; half < halves; ++half) {
            const std::int64_t index = k == 0 ? 0 : 2 * address.index + half;
            if (below(5) != 0) add({address.time_level + 1, index});
        }
    }

    ClipShape shape_;
    std::size_t levels_;
    std::mt19937 random_;
    std::vector<Siblings> chain_;
    std::vector<Siblings> made_;
};

std::uint64_t number_at(const std::vector<std::byte>& file, std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, file.data() + at, sizeof value);
    return value;
}
void put_at(std::vector<std::byte>& file, std::size_t at, std::uint64_t value) {
    std::memcpy(file.data() + at, &value, sizeof value);
}

// The slot of more generations: the newest, or what was made of it.
std::size_t newest_slot(const std::vector<std::byte>& file) {
    const std::size_t second = kMrvSlotsAt + kMrvSlotBytes;
    return number_at(file, kMrvSlotsAt) < number_at(file, second) ? second : kMrvSlotsAt;
}

}  // namespace

LinkedClip linked_clip(int width, int height, int frames, std::uint32_t seed) {
    const ClipShape shape = *ClipShape::make({width, height, {30000, 1001}}, frames);
    return {shape, seed % 1000, Maker(shape, seed).make()};
}

std::vector<std::byte> mrv_bytes(const LinkedClip& clip) {
    MemorySpool waiting;
    MemorySpool file;
    MrvWriter writer(waiting, file);
    bool written = writer.begin(clip.shape, clip.delta).has_value();
    for (const Siblings& siblings : clip.siblings)
        written = written && writer.add(siblings).has_value();
    written = written && writer.finish().has_value();
    std::vector<std::byte> bytes(writer.file_bytes());
    written = written && file.read(0, bytes).has_value();
    assert(written);
    return bytes;
}

void seal_header(std::vector<std::byte>& file) {
    const std::size_t slot = newest_slot(file);
    std::vector<std::byte> checked(file.begin(), file.begin() + kMrvSlotsAt);
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(slot);
    checked.insert(checked.end(), begin, begin + kMrvSlotBytes - 8);
    put_at(file, slot + kMrvSlotBytes - 8, mrv_checksum(checked));
}

void seal_front(std::vector<std::byte>& file) {
    const std::size_t slot = newest_slot(file);
    const std::uint64_t generations = number_at(file, slot);
    const std::uint64_t table = number_at(file, slot + 8);
    if (generations <= kMostGenerations && table <= file.size() &&
        generations * kMrvRecordBytes <= file.size() - table) {
        std::uint64_t begin = kMrvHeaderBytes;
        for (std::size_t g = 0; g < generations; ++g) {
            const std::size_t record = table + g * kMrvRecordBytes;
            const std::uint64_t index = begin + (g + 1) * kMrvRecordBytes;
            const std::uint64_t bytes = number_at(file, record + 16);
            begin = number_at(file, record + 24);
            if (index > file.size() || bytes > file.size() - index) continue;
            put_at(
                file, record + 32, mrv_checksum(std::span(file).subspan(index, bytes)));
        }
        put_at(
            file,
            slot + 16,
            mrv_checksum(std::span(file).subspan(table, generations * kMrvRecordBytes)));
    }
    seal_header(file);
}

}  // namespace haarmony::video::testing
