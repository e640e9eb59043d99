// Keeps a list of free blocks in front of malloc. glibc's own settings do not suffice: a small allocation in
// a freed block makes it too small for the next of its size, and the heap grows with each repetition.

#include "benchmarks/kept_memory.h"

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>

namespace {

constexpr size_t kLarge = size_t(1) << 20, kAlign = 64;

// Precedes each block, which begins at a multiple of kAlign.
struct Header {
  size_t size = 0;
  void* next = nullptr;
};
static_assert(sizeof(Header) <= kAlign);

struct Kept {
  std::mutex mutex;
  bool keep = false;
  void* first = nullptr;  // free blocks
};
Kept& kept() {
  static Kept k;
  return k;
}

Header& header(void* block) {
  return *reinterpret_cast<Header*>(static_cast<std::byte*>(block) - kAlign);
}

void* take_kept(size_t size) {
  const std::lock_guard lock(kept().mutex);
  for (void** at = &kept().first; *at; at = &header(*at).next) {
    if (header(*at).size != size) continue;
    void* const block = *at;
    *at = header(block).next;
    return block;
  }
  return nullptr;
}

void* take(size_t size, size_t align) {
  if (align > kAlign) throw std::bad_alloc();
  if (size >= kLarge)
    if (void* const block = take_kept(size)) return block;
  void* const memory = std::aligned_alloc(kAlign, (size + 2 * kAlign - 1) / kAlign * kAlign);
  if (!memory) throw std::bad_alloc();
  void* const block = static_cast<std::byte*>(memory) + kAlign;
  header(block) = {size, nullptr};
  return block;
}

void give(void* block) {
  if (!block) return;
  if (header(block).size >= kLarge) {
    const std::lock_guard lock(kept().mutex);
    if (kept().keep) {
      header(block).next = kept().first;
      kept().first = block;
      return;
    }
  }
  std::free(&header(block));
}

}  // namespace

namespace kaustik::benchmarks {

void keep_large_blocks() {
  const std::lock_guard lock(kept().mutex);
  kept().keep = true;
}

}  // namespace kaustik::benchmarks

void* operator new(size_t size) {
  return take(size, kAlign);
}
void* operator new(size_t size, std::align_val_t align) {
  return take(size, size_t(align));
}
void operator delete(void* block) noexcept {
  give(block);
}
void operator delete(void* block, size_t) noexcept {
  give(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  give(block);
}
void operator delete(void* block, size_t, std::align_val_t) noexcept {
  give(block);
}
