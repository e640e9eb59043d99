#pragma once
// How much more memory the process may take.

#include <cstdint>
#include <limits>
#include <string>

namespace kaustik {

// In three digits: "20.5 MB", "1.5 GB", "2 TB".
std::string size_text(uint64_t bytes);

// A limit of what the process holds. A value; const functions are thread-safe.
class MemoryRoom {
 public:
  MemoryRoom() = default;  // without a limit
  // limit: in bytes, of held_memory(). source: what sets it, for messages.
  MemoryRoom(uint64_t limit, std::string source) : limit_(limit), source_(std::move(source)) {}

  // Bytes that may be taken beside those that the process holds now.
  uint64_t left() const;
  // Why so many bytes more cannot be taken; empty if they can.
  std::string lacks(uint64_t bytes) const;
  // Says that the process holds more than the limit; empty if it does not.
  std::string exceeded() const;

 private:
  uint64_t limit_ = std::numeric_limits<uint64_t>::max();
  std::string source_;
};

}  // namespace kaustik
