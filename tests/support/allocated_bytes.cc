#include "tests/support/allocated_bytes.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> now{0};
std::atomic<std::int64_t> most{0};

// Before each piece stands its size, in room of the piece's alignment.
constexpr std::size_t kRoom = alignof(std::max_align_t);

void* allocate(std::size_t size, std::size_t alignment) {
    const std::size_t room = std::max(kRoom, alignment);
    const std::size_t whole = (room + size + room - 1) / room * room;
    auto* const begin = static_cast<std::byte*>(std::aligned_alloc(room, whole));
    if (begin == nullptr) std::abort();  // a test that is out of memory has failed
    std::byte* const piece = begin + room;
    new (piece - sizeof(std::size_t)) std::size_t(size);
    const std::int64_t live = now += std::int64_t(size);
    std::int64_t before = most;
    while (before < live && !most.compare_exchange_weak(before, live)) {
    }
    return piece;
}

void release(void* piece, std::size_t alignment) {
    if (piece == nullptr) return;
    auto* const bytes = static_cast<std::byte*>(piece);
    now -= std::int64_t(*reinterpret_cast<std::size_t*>(bytes - sizeof(std::size_t)));
    std::free(bytes - std::max(kRoom, alignment));
}

}  // namespace

// All forms: where a sanitizer's library stands beneath, those left out would be its own.
void* operator new(std::size_t size) { return allocate(size, kRoom); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, std::size_t(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, kRoom);
}
void* operator new(std::size_t size,
                   std::align_val_t alignment,
                   const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(alignment));
}
void operator delete(void* piece) noexcept { release(piece, kRoom); }
void operator delete(void* piece, std::size_t) noexcept { release(piece, kRoom); }
void operator delete(void* piece, const std::nothrow_t&) noexcept {
    release(piece, kRoom);
}
void operator delete(void* piece, std::align_val_t alignment) noexcept {
    release(piece, std::size_t(alignment));
}
void operator delete(void* piece,
                     std::align_val_t alignment,
                     const std::nothrow_t&) noexcept {
    release(piece, std::size_t(alignment));
}
void operator delete(void* piece, std::size_t, std::align_val_t alignment) noexcept {
    release(piece, std::size_t(alignment));
}
void* operator new[](std::size_t size) { return allocate(size, kRoom); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, std::size_t(alignment));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, kRoom);
}
void* operator new[](std::size_t size,
                     std::align_val_t alignment,
                     const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(alignment));
}
void operator delete[](void* piece) noexcept { release(piece, kRoom); }
void operator delete[](void* piece, std::size_t) noexcept { release(piece, kRoom); }
void operator delete[](void* piece, const std::nothrow_t&) noexcept {
    release(piece, kRoom);
}
void operator delete[](void* piece, std::align_val_t alignment) noexcept {
    release(piece, std::size_t(alignment));
}
void operator delete[](void* piece,
                       std::align_val_t alignment,
                       const std::nothrow_t&) noexcept {
    release(piece, std::size_t(alignment));
}
void operator delete[](void* piece, std::size_t, std::align_val_t alignment) noexcept {
    release(piece, std::size_t(alignment));
}

namespace haarmony::test {

std::int64_t allocated_bytes() { return now; }
std::int64_t most_allocated_bytes() { return most; }
void watch_allocated_bytes() { most = now.load(); }

}  // namespace haarmony::test
