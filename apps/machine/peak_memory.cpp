#include "apps/machine/peak_memory.h"

#include <algorithm>
#include <fstream>

#include "core/memory/memory_pages.h"
#include "core/memory/process_memory.h"

namespace kaustik::app {

bool restart_peak_memory() {
  give_back_freed();
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  file.close();
  return bool(file);
}

uint64_t peak_held_memory() {
  const uint64_t peak = status_bytes("VmHWM:");
  return peak - std::min(peak, process_memory().of_files);
}

}  // namespace kaustik::app
