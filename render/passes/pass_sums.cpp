// Adds the sums of two parts of a render.

#include "render/passes/pass_sums.h"

#include <stdexcept>

namespace kaustik::render {

void PassSums::add(const PassSums& other) {
  if (!passes.common(other.passes).empty()) throw std::invalid_argument("both sums contain the same pass");
  if (shares != other.shares)
    throw std::invalid_argument("the sums divide the photons among different numbers of passes");
  if (radii && other.radii && *radii != *other.radii)
    throw std::invalid_argument("the sums' gather radii differ");
  totals.add(other.totals);
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
