// Hashes bytes in words of eight, whatever their split into calls.

#include "core/files/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/math/hash.h"

namespace kaustik {

namespace {

uint64_t little_endian(const unsigned char* bytes) {
  uint64_t word = 0;
  for (int i = 7; i >= 0; --i) word = word << 8 | bytes[i];
  return word;
}

}  // namespace

void ContentHash::add_word(uint64_t word) {
  for (uint64_t& state : state_) state = hash_combine(state, word);
}

void ContentHash::add(const void* bytes, size_t size) {
  const auto* next = static_cast<const unsigned char*>(bytes);
  while (size > 0) {
    const size_t filled = size_ % 8;
    if (filled == 0 && size >= 8) {
      for (; size >= 8; size -= 8, next += 8, size_ += 8) add_word(little_endian(next));
      continue;
    }
    const size_t taken = std::min(size, 8 - filled);
    std::memcpy(pending_.data() + filled, next, taken);
    size_ += taken, next += taken, size -= taken;
    if (size_ % 8 == 0) add_word(little_endian(pending_.data()));
  }
}

std::array<uint64_t, 2> ContentHash::words() const {
  ContentHash end = *this;
  if (size_ % 8 != 0) {
    std::fill(end.pending_.begin() + size_ % 8, end.pending_.end(), static_cast<unsigned char>(0));
    end.add_word(little_endian(end.pending_.data()));
  }
  end.add_word(size_);
  return end.state_;
}

std::string ContentHash::text() const {
  const auto [high, low] = words();
  return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace kaustik
