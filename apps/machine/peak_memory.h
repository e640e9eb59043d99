#pragma once
// The most memory that the process has held.

#include <cstdint>

namespace kaustik::app {

// Restarts the measurement behind render::peak_memory_bytes(): returns free memory to the system and resets
// the peak to what is resident now (proc(5), clear_refs; Linux 4.0 or later). False if the system refuses;
// the peak then remains that of the whole process.
bool restart_peak_memory();

// Bytes that the process has held at most, as held_memory() counts them: without the pages of files that are
// resident now, since the kernel keeps no maximum without them. 0 if it cannot be read.
uint64_t peak_held_memory();

}  // namespace kaustik::app
