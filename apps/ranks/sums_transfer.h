#pragma once
// Sums of passes in messages: a head, then the bytes of the pixels in pieces.

#include <string>

#include "render/passes/partial_manifest.h"

namespace kaustik::app {

class OutgoingSums {
 public:
  explicit OutgoingSums(render::PassSums sums) : sums_(std::move(sums)) {}
  std::string head() const { return render::manifest_text({}, sums_); }
  bool has_more() const;
  std::string next_piece();  // requires has_more()
  render::PassSums take() { return std::move(sums_); }

 private:
  render::PassSums sums_;
  size_t block_ = 0, begin_ = 0;  // what comes next: of bytes_of(), and in it
};

class IncomingSums {
 public:
  // spare: sums whose memory may be used again. Throws as manifest_from_text() does.
  IncomingSums(const std::string& head, render::PassSums spare);
  // Throws std::runtime_error for bytes beyond the last pixel.
  void add(const std::string& piece);
  bool complete() const { return missing_ == 0; }
  render::PassSums take() { return std::move(sums_); }

 private:
  render::PassSums sums_;
  size_t block_ = 0, begin_ = 0;
  uint64_t missing_ = 0;  // bytes
};

}  // namespace kaustik::app
