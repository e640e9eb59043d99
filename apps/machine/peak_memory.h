#pragma once
// Restarts the measurement behind render::peak_memory_bytes().

namespace kaustik::app {

// Returns free memory to the system and resets the peak to what is resident now (proc(5), clear_refs;
// Linux 4.0 or later). False if the system refuses; the peak then remains that of the whole process.
bool restart_peak_memory();

}  // namespace kaustik::app
