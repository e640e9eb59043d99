#include "core/memory/memory_room.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace kaustik {

uint64_t held_memory(const std::string& root) {
  std::ifstream file(root +
                     "/proc/self/statm");  // proc(5): pages of address space, resident ones, those of files
  uint64_t mapped = 0, resident = 0, of_files = 0;
  if (!(file >> mapped >> resident >> of_files)) return 0;
  return (resident - std::min(resident, of_files)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string size_text(uint64_t bytes) {
  const double size = static_cast<double>(bytes);
  if (size < 1e9) return fmt::format("{:.3g} MB", size / 1e6);
  return size < 1e12 ? fmt::format("{:.3g} GB", size / 1e9) : fmt::format("{:.3g} TB", size / 1e12);
}

uint64_t MemoryRoom::left() const {
  if (limit_ == std::numeric_limits<uint64_t>::max()) return limit_;
  return limit_ - std::min(limit_, held_memory());
}

std::string MemoryRoom::lacks(uint64_t bytes) const {
  const uint64_t left = this->left();
  if (bytes <= left) return {};
  return fmt::format("it needs about {} of memory, but {} leaves {}", size_text(bytes), source_,
                     size_text(left));
}

}  // namespace kaustik
