#pragma once
// 128 bits that tell contents apart: files that changed, bytes that were damaged. Not for adversaries.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kaustik {

// Two independent chains of hash_combine over the bytes, eight at a time, and their number. However the bytes
// are cut into calls, the value is the same.
class ContentHash {
 public:
  void add(const void* bytes, size_t size);
  void add(std::string_view text) { add(text.data(), text.size()); }
  std::array<uint64_t, 2> words() const;
  std::string text() const;  // 32 hexadecimal digits

 private:
  void add_word(uint64_t word);

  std::array<uint64_t, 2> state_{0x6b617573, 0x74696b};
  std::array<unsigned char, 8> pending_{};
  uint64_t size_ = 0;
};

}  // namespace kaustik
