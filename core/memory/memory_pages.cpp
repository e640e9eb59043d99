// Implemented with madvise where it exists.

#include "core/memory/memory_pages.h"

#include <cstdlib>  // defines __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace kaustik {

#ifdef __linux__

namespace {

void advise(void* data, size_t bytes, int advice) {
  const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
  const uintptr_t begin = (reinterpret_cast<uintptr_t>(data) + page - 1) / page * page;
  const uintptr_t end = (reinterpret_cast<uintptr_t>(data) + bytes) / page * page;
  // If the call is refused, the pages stay as they are.
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}

}  // namespace

void prefer_large_pages(void* data, size_t bytes) {
  advise(data, bytes, MADV_HUGEPAGE);
}
void give_back_pages(void* data, size_t bytes) {
  advise(data, bytes, MADV_DONTNEED);
}

#else

void prefer_large_pages(void*, size_t) {}
void give_back_pages(void*, size_t) {}

#endif

void give_back_freed() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace kaustik
