#include "apps/machine/peak_memory.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "core/memory/memory_pages.h"

namespace kaustik::app {

bool restart_peak_memory() {
  give_back_freed();
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  file.close();
  return bool(file);
}

uint64_t peak_held_memory() {
  std::ifstream file("/proc/self/status");
  uint64_t peak = 0, of_files = 0;  // kilobytes
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmHWM:")) peak = std::stoull(line.substr(6));
    if (line.starts_with("RssFile:")) of_files = std::stoull(line.substr(8));
  }
  return (peak - std::min(peak, of_files)) * 1024;
}

}  // namespace kaustik::app
