// A library to preload: of the allocations of at least KAUSTIK_ALLOCATION_BYTES bytes, that of number
// KAUSTIK_FAIL_ALLOCATION, counted from 1, fails. How many there were is written at the end to the file
// KAUSTIK_ALLOCATIONS_TO. Operators new of the program and its libraries come here, too, by way of malloc().

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

extern "C" {
// What glibc calls its own functions.
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

std::atomic<long> made = 0;
long failing = 0;  // 0: none
size_t least_bytes = 0;
bool counts = false;  // not before the library is initialised

long number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text ? std::atol(text) : 0;
}

struct Session {
  Session() {
    failing = number_in("KAUSTIK_FAIL_ALLOCATION");
    least_bytes = static_cast<size_t>(number_in("KAUSTIK_ALLOCATION_BYTES"));
    counts = true;
  }
  ~Session() {
    counts = false;
    const char* const path = std::getenv("KAUSTIK_ALLOCATIONS_TO");
    std::FILE* const file = path ? std::fopen(path, "w") : nullptr;
    if (!file) return;
    std::fprintf(file, "%ld\n", made.load());
    std::fclose(file);
  }
} session;

bool fails(size_t bytes) {
  if (!counts || bytes < least_bytes || ++made != failing) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" {

void* malloc(size_t bytes) {
  return fails(bytes) ? nullptr : __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
  return fails(count * bytes) ? nullptr : __libc_calloc(count, bytes);
}
void* realloc(void* old, size_t bytes) {
  return fails(bytes) ? nullptr : __libc_realloc(old, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
  return fails(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
  return memalign(alignment, bytes);
}
int posix_memalign(void** out, size_t alignment, size_t bytes) {
  *out = memalign(alignment, bytes);
  return *out ? 0 : ENOMEM;
}
}
