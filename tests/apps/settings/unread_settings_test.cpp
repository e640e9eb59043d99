// Settings of the command line that the chosen method does not read.

#include "apps/settings/unread_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> unread(std::vector<std::pair<std::string, std::string>> given) {
  SettingOverrides overrides;
  for (auto& [name, text] : given) overrides.add(*find_setting(name), {std::move(text)});
  SceneNeeds needs;
  needs.any_light = needs.diffuse = needs.specular = true;
  return unread_settings(overrides, render::make_plan(overrides.alone().render, needs));
}

TEST(UnreadSettings, PathTracingReadsNoPhotonSettings) {
  EXPECT_THAT(unread({{"method", "mc"}, {"photons", "1M"}, {"radius", "0.1"}, {"spp", "4"}}),
              ElementsAre(HasSubstr("--photons has no effect"), HasSubstr("--radius has no effect")));
}

TEST(UnreadSettings, TheLecturesTestAloneReadsItsThreshold) {
  EXPECT_THAT(unread({{"method", "photon"}, {"min-photons", "4"}}), ElementsAre(HasSubstr("--min-photons")));
  EXPECT_THAT(unread({{"method", "hybrid"}, {"min-photons", "4"}}), IsEmpty());
}

TEST(UnreadSettings, MethodAutoReadsPhotonsAndAdaptiveSamples) {
  EXPECT_THAT(unread({{"photons", "1M"}, {"radius", "2x"}, {"guide", "off"}, {"adaptive", "off"}}),
              IsEmpty());
  EXPECT_THAT(unread({{"method", "mc"}, {"adaptive", "off"}}), ElementsAre(HasSubstr("--adaptive")));
}

}  // namespace
}  // namespace kaustik::app
