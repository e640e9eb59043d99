#pragma once
// A 128-bit hash that detects changed files and damaged data. It is not cryptographic.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kaustik {

// Two independent chains of hash_combine over the bytes, eight at a time, and their number. The value does
// not depend on how the bytes are split into calls.
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
