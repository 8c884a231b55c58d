// Segments of random pictures, and copies of their bytes that may be damaged.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <random>
#include <span>
#include <vector>

#include "engine/image/segment.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {

// Few places: some lists are popular. Many places: all others are rare.
inline std::vector<Record> make_records(std::mt19937& random, int count) {
    std::vector<Record> records;
    for (int i = 0; i < count; ++i) {
        const SignatureShape popular{60, 120};
        const SignatureShape rare{60};
        Record record;
        record.id = ImageId{3 * i + 1};
        record.signature = random_signature(random, i % 3 == 0 ? rare : popular);
        record.log_aspect = i;
        records.push_back(record);
    }
    return records;
}

inline std::shared_ptr<const Segment> make_segment(std::span<const Record> records,
                                                   int index_m) {
    std::vector<const Record*> pointers;
    for (const Record& record : records) pointers.push_back(&record);
    return Segment::from_records(pointers, index_m);
}

inline std::span<const std::byte> bytes_of(const Segment& segment) {
    return {reinterpret_cast<const std::byte*>(segment.view().terms.data()),
            segment.bytes().total};
}

// A segment's bytes, to be damaged.
class Copy {
  public:
    explicit Copy(const Segment& segment)
        : counts(segment.view().counts), size_(bytes_of(segment).size()) {
        bytes_.reset(static_cast<std::byte*>(::operator new[](size_, kAlignment)));
        std::ranges::copy(bytes_of(segment), bytes_.get());
    }

    [[nodiscard]] std::span<std::byte> bytes() { return {bytes_.get(), size_}; }
    [[nodiscard]] SegmentUnderConstruction spans() { return spans_of(counts, bytes()); }
    [[nodiscard]] Result<SegmentView> view() {
        return view_segment(counts, std::span<const std::byte>(bytes()));
    }

    SegmentCounts counts;

  private:
    static constexpr std::align_val_t kAlignment{64};
    struct Free {
        void operator()(std::byte* bytes) const {
            ::operator delete[](bytes, kAlignment);
        }
    };
    std::size_t size_;
    std::unique_ptr<std::byte[], Free> bytes_;
};

}  // namespace haarmony::image
