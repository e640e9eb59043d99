#include "core/memory/memory_room.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/memory/process_memory.h"

namespace kaustik {

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

std::string MemoryRoom::exceeded() const {
  if (left() > 0) return {};
  return fmt::format("the shapes up to this one take more memory than {} allows", source_);
}

}  // namespace kaustik
