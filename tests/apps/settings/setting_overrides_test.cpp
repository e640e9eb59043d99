// Settings that are given over those of the scene file.

#include <gtest/gtest.h>

#include "apps/settings/setting_options.h"

namespace kaustik::app {
namespace {

SettingOverrides given(const std::string& name, const std::string& text) {
  SettingOverrides overrides;
  overrides.add(*find_setting(name), {text});
  return overrides;
}

// The page of `view` appends what its readers ask for, render after render.
TEST(SettingOverrides, ALaterValueTakesThePlaceOfAnEarlierOne) {
  SettingOverrides all = given("spp", "4");
  for (const char* photons : {"1k", "20k", "300k"}) all.append(given("photons", photons));
  EXPECT_EQ(all.size(), 2u);
  EXPECT_EQ(all.alone().render.photons, 300'000u);
  EXPECT_EQ(all.alone().render.spp, 4);
}

}  // namespace
}  // namespace kaustik::app
