#pragma once
// Makes render::peak_memory_bytes() the peak of what follows.

namespace kaustik::app {

// Gives free memory back to the system and sets the peak to what is resident now (Linux 4.0, proc(5),
// clear_refs). False where the system refuses: then the peak stays that of the whole process.
bool restart_peak_memory();

}  // namespace kaustik::app
