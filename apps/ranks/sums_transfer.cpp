#include "apps/ranks/sums_transfer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "apps/ranks/rank_calls.h"

namespace kaustik::app {

namespace {

// Goes on to the next block that is not empty, once all of one has been passed.
template <class Blocks>
void pass_finished(const Blocks& blocks, size_t* block, size_t* begin) {
  while (*block < blocks.size() && *begin == blocks[*block].size()) ++*block, *begin = 0;
}

}  // namespace

bool OutgoingSums::has_more() const {
  const auto blocks = render::bytes_of(sums_.totals);
  return block_ < blocks.size() && begin_ < blocks[block_].size();
}

std::string OutgoingSums::next_piece() {
  const auto blocks = render::bytes_of(std::as_const(sums_.totals));
  const std::span<const std::byte> left = blocks[block_].subspan(begin_);
  const size_t size = std::min(left.size(), kPixelBytes);
  begin_ += size;
  pass_finished(blocks, &block_, &begin_);
  return {reinterpret_cast<const char*>(left.data()), size};
}

IncomingSums::IncomingSums(const std::string& head, render::PassSums spare) {
  render::ReadManifest read = render::manifest_from_text(head);
  missing_ = read.pixel_bytes();
  sums_ = std::move(read.result.sums);
  const render::PixelWindow<render::PixelTotals>& pixels = spare.totals.pixels();
  const bool fits = pixels.width() == read.width && pixels.height() == read.height &&
                    pixels.x0() == read.x0 && pixels.y0() == read.y0 && spare.totals.units() == read.units &&
                    spare.totals.has_halves() == read.halves && spare.totals.has_media() == read.media;
  sums_.totals = fits ? std::move(spare.totals) : read.empty_totals();
}

void IncomingSums::add(const std::string& piece) {
  const auto blocks = render::bytes_of(sums_.totals);
  if (piece.size() > missing_ || begin_ + piece.size() > blocks[block_].size())
    throw std::runtime_error("a rank has sent more pixels than the picture has");
  std::memcpy(blocks[block_].data() + begin_, piece.data(), piece.size());
  begin_ += piece.size();
  missing_ -= piece.size();
  pass_finished(blocks, &block_, &begin_);
}

}  // namespace kaustik::app
