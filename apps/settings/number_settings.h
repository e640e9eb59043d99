#pragma once
// Rows of the settings table that hold a number with a fraction, and the forms of a radius.

#include "apps/settings/table.h"

namespace kaustik::app {

// r0 as people ask for it: metres, or a multiple of what the program chooses for each map.
struct RadiusChoice {
  std::optional<float> metres;
  float factor = 1;  // of auto's radii, where metres is unset

  static RadiusChoice of(const Settings& settings);
  void apply(Settings& settings) const;
  std::string text() const;  // "auto", "0.5x" or "0.011": parse_radius gives the choice back
  bool operator==(const RadiusChoice&) const = default;
};

// "auto", "0.5x" or metres, above zero; nothing otherwise.
std::optional<RadiusChoice> parse_radius(std::string_view text);

Setting radius_setting();
Setting alpha_setting();
Setting adaptive_setting();
Setting cone_k_setting();
Setting exposure_setting();

}  // namespace kaustik::app
