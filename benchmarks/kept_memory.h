#pragma once
// Large blocks of memory that stay with the program when they are freed, for timings without the system's
// work for fresh pages. Linking kept_memory.cpp replaces operator new and delete.

namespace kaustik::benchmarks {

// From now on, blocks of a megabyte and more are kept, and given to who asks for the same size again.
void keep_large_blocks();

}  // namespace kaustik::benchmarks
