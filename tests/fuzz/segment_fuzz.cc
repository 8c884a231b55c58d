// Whatever is done to the bytes of a segment: refused with a reason, or searched without a look
// outside of them; and what the complete check lets pass can be merged, too.
//
// An input is a list of changes, five bytes each: where, and what is put there.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "engine/image/collection.h"
#include "engine/image/collection_search.h"
#include "tests/engine/image/segment_bytes.h"

namespace {

using namespace haarmony;
using namespace haarmony::image;

constexpr int kIndexM = 45;
constexpr int kSlots = 300;

void require(bool holds) {
    if (!holds) std::abort();
}

const Segment& whole() {
    static const std::shared_ptr<const Segment> segment = [] {
        std::mt19937 random(1);
        return make_segment(make_records(random, kSlots), kIndexM);
    }();
    return *segment;
}

void search_all(const std::shared_ptr<const Segment>& segment) {
    static const std::vector<Query> queries = [] {
        std::mt19937 random(2);
        std::vector<Query> made;
        for (const int m : {7, 20, 33, 40, kIndexM})
            made.push_back(make_query(
                random_signature(random, {60, 120}), *built_in_profile("painted"), m));
        return made;
    }();
    Collection collection;
    collection.index_m = kIndexM;
    collection.segments.push_back({segment, nullptr});
    collection.tail.records = std::make_shared<Tail>(1);
    for (const Query& query : queries) {
        SearchScope scope;
        scope.limit = 20;
        (void)search(collection, query, scope);
        require(score_all(collection, query, nullptr).size() == kSlots);
    }
    for (int id = 0; id < 3 * kSlots; id += 7) (void)segment->find(ImageId{id});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t size) {
    const auto copy = std::make_shared<Copy>(whole());
    const std::span<std::byte> bytes = copy->bytes();
    for (std::size_t at = 0; at + 5 <= size; at += 5) {
        std::uint32_t place = 0;
        std::memcpy(&place, input + at, sizeof place);
        bytes[place % bytes.size()] = std::byte{input[at + 4]};
    }
    const auto known = view_known_segment(copy->counts, bytes);
    const auto complete = view_segment(copy->counts, bytes);
    require(known.has_value() || !complete.has_value());
    if (!known) {
        require(!known.error().message.empty());
        return 0;
    }
    const auto segment = Segment::from_view(known.value(), copy);
    search_all(segment);
    if (!complete) return 0;
    const LiveSegment part{segment, nullptr};
    const auto merged = Segment::merge({&part, 1});
    require(view_segment(merged->view().counts, bytes_of(*merged)).has_value());
    return 0;
}
