#pragma once
// Rows of the settings table that hold a real number, and the forms of a gather radius.

#include "apps/settings/table/table.h"

namespace kaustik::app {

// A requested radius r0: in metres, or as a multiple of the radius that `auto` chooses for each map.
struct RadiusChoice {
  std::optional<float> metres;
  float factor = 1;  // multiple of auto's radii, if `metres` is unset

  static RadiusChoice of(const Settings& settings);
  void apply(Settings& settings) const;
  std::string text() const;  // "auto", "0.5x" or "0.011"; parse_radius reads it back
  bool operator==(const RadiusChoice&) const = default;
};

// Parses "auto", a multiple such as "0.5x", or metres, above zero; nothing for other texts.
std::optional<RadiusChoice> parse_radius(std::string_view text);

Setting radius_setting();
Setting alpha_setting();
Setting adaptive_setting();
Setting cone_k_setting();
Setting exposure_setting();

}  // namespace kaustik::app
