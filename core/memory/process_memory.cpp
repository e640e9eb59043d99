#include "core/memory/process_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace kaustik {

ProcessMemory process_memory(const std::string& root) {
  std::ifstream file(root + "/proc/self/statm");  // in pages
  uint64_t mapped = 0, resident = 0, of_files = 0, code = 0, unused = 0, data = 0;
  if (!(file >> mapped >> resident >> of_files >> code >> unused >> data)) return {};
  const auto page = static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  return {mapped * page, resident * page, of_files * page, data * page};
}

uint64_t held_memory(const std::string& root) {
  const ProcessMemory memory = process_memory(root);
  return memory.resident - std::min(memory.resident, memory.of_files);
}

uint64_t status_bytes(std::string_view name) {
  std::ifstream status("/proc/self/status");  // in kilobytes
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return std::stoull(line.substr(name.size())) * 1024;
  return 0;
}

}  // namespace kaustik
