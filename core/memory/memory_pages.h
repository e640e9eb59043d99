#pragma once
// What the operating system is told about large arrays. Hints: where there is no madvise, nothing happens.

#include <cstddef>

namespace kaustik::photon {

// Asks for large pages, of which a big array needs few: they are faster to get, and to find again. Call it
// before the memory is first written.
void prefer_large_pages(void* data, size_t bytes);

// Gives back the memory of the whole pages in [data, data + bytes), which then holds anything. The addresses
// remain the caller's, to be freed as ever.
void give_back_pages(void* data, size_t bytes);

}  // namespace kaustik::photon
