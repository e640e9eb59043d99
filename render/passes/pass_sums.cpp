// Adds the sums of two parts of a render.

#include "render/passes/pass_sums.h"

#include <stdexcept>

namespace kaustik::render {

namespace {

bool has_pixels(const PassSums& sums) {
  return sums.totals.pixels().width() > 0;
}

// Adds the totals, of which those of no pass may have no pixels.
void add_totals(const PassSums& from, PassSums* to) {
  if (from.passes.empty() && !has_pixels(from)) return;
  if (to->passes.empty() && !has_pixels(*to))
    to->totals = from.totals;
  else
    to->totals.add(from.totals);
}

}  // namespace

void PassSums::add(const PassSums& other) {
  if (!passes.common(other.passes).empty()) throw std::invalid_argument("both sums contain the same pass");
  if (shares != other.shares)
    throw std::invalid_argument("the sums divide the photons among different numbers of passes");
  if (radii && other.radii && *radii != *other.radii)
    throw std::invalid_argument("the sums' gather radii differ");
  add_totals(other, this);
  passes.add(other.passes);
  if (!radii) radii = other.radii;
  statistics += other.statistics;
}

void PassSums::clear() {
  passes = {};
  totals.clear();
  statistics = {};
}

}  // namespace kaustik::render
