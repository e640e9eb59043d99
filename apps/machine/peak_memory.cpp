#include "apps/machine/peak_memory.h"

#include <fstream>

#include "core/memory/memory_pages.h"

namespace kaustik::app {

bool restart_peak_memory() {
  give_back_freed();
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  file.close();
  return bool(file);
}

}  // namespace kaustik::app
