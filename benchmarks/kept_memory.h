#pragma once
// Keeps large freed blocks of memory in the program, for timings without the system's cost of fresh pages.
// Linking kept_memory.cpp replaces operator new and delete.

namespace kaustik::benchmarks {

// After this call freed blocks of a megabyte and more are kept and reused for requests of the same size.
void keep_large_blocks();

}  // namespace kaustik::benchmarks
