#pragma once
// Hints to the operating system about large arrays. They have no effect where madvise does not exist.

#include <cstddef>

namespace kaustik {

// Asks for large pages. A big array then needs few of them, so they take less time to allocate and cause
// fewer TLB misses. Call it before the memory is first written.
void prefer_large_pages(void* data, size_t bytes);

// Returns the memory of the whole pages in [data, data + bytes) to the system; their contents are unspecified
// afterwards. The address range remains the caller's, to be freed as usual.
void give_back_pages(void* data, size_t bytes);

// Returns to the system what the C library keeps of freed memory. It takes some milliseconds.
void give_back_freed();

}  // namespace kaustik
