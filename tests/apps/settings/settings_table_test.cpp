#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "apps/settings/table/table.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;

std::optional<std::string> assign(Settings& settings, std::string_view name, std::vector<std::string> texts) {
  const Setting* setting = find_setting(name);
  if (!setting) return "no setting " + std::string(name);
  return setting->assign(settings, texts);
}

TEST(SettingsTable, NamesAreUniqueAndEveryRowIsExplained) {
  std::set<std::string_view> names;
  for (const Setting& setting : settings_table()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_FALSE(setting.doc.empty()) << setting.name;
    EXPECT_FALSE(setting.default_text.empty()) << setting.name;
    EXPECT_FALSE(setting.range.empty()) << setting.name;
  }
}

// The parser accepts every choice that the table lists for a setting.
TEST(SettingsTable, EveryListedChoiceIsAccepted) {
  for (const Setting& setting : settings_table()) {
    for (const std::string_view value : setting.choices) {
      Settings settings;
      const std::string text(value);
      EXPECT_EQ(setting.assign(settings, {&text, 1}), std::nullopt) << setting.name << " " << value;
    }
  }
}

TEST(SettingsTable, DashesInNamesMayBeLeftOut) {
  EXPECT_EQ(find_setting("conek"), find_setting("cone-k"));
  EXPECT_NE(find_setting("conek"), nullptr);
  EXPECT_EQ(find_setting("maxbounces"), find_setting("max-bounces"));
  EXPECT_EQ(find_setting("cone"), nullptr);
  EXPECT_EQ(find_setting(""), nullptr);
}

TEST(SettingsTable, ValuesAreStoredInTheirFields) {
  Settings s;
  EXPECT_EQ(assign(s, "method", {"hybrid"}), std::nullopt);
  EXPECT_EQ(assign(s, "direct", {"lecture"}), std::nullopt);
  EXPECT_EQ(assign(s, "photons", {"10G"}), std::nullopt);
  EXPECT_EQ(assign(s, "radius", {"0.125"}), std::nullopt);
  EXPECT_EQ(assign(s, "crop", {"1", "5", "2", "9"}), std::nullopt);
  EXPECT_EQ(assign(s, "aov", {"direct,depth", "normal"}), std::nullopt);
  EXPECT_EQ(assign(s, "exposure", {"-1.5"}), std::nullopt);
  EXPECT_EQ(s.render.method, render::Method::kHybrid);
  EXPECT_EQ(s.render.direct, render::DirectEstimator::kLecture);
  EXPECT_EQ(s.render.photons, 10'000'000'000u);
  EXPECT_EQ(s.render.radius, 0.125f);
  EXPECT_EQ(s.render.crop.x0, 1);
  EXPECT_EQ(s.render.crop.x1, 5);
  EXPECT_EQ(s.render.crop.y0, 2);
  EXPECT_EQ(s.render.crop.y1, 9);
  EXPECT_THAT(s.render.aov, ::testing::ElementsAre("direct", "depth", "normal"));
  EXPECT_EQ(s.tone.exposure, -1.5f);
  EXPECT_EQ(assign(s, "exposure", {"auto"}), std::nullopt);
  EXPECT_EQ(s.tone.exposure, std::nullopt);
  EXPECT_EQ(assign(s, "radius", {"auto"}), std::nullopt);
  EXPECT_EQ(s.render.radius, std::nullopt);
  EXPECT_EQ(assign(s, "adaptive", {"1.25"}), std::nullopt);
  EXPECT_EQ(s.render.adaptive, 1.25f);
  EXPECT_EQ(assign(s, "adaptive", {"off"}), std::nullopt);
  EXPECT_EQ(s.render.adaptive, 0);
  EXPECT_EQ(assign(s, "adaptive", {"on"}), std::nullopt);
  EXPECT_EQ(s.render.adaptive, Settings().render.adaptive);
}

// A shown value can be parsed again, so a render can be continued with the same settings.
TEST(SettingsTable, ShownValuesParseToTheSameSettings) {
  Settings s;
  s.render.direct = render::DirectEstimator::kLecture;
  s.render.photons = 12'345'678'901u;
  s.render.radius = 0.1f;
  s.render.alpha = 2.0f / 3;
  s.render.seed = ~uint64_t{0};
  s.render.crop = {1, 5, 2, 9};
  s.render.aov = {"direct", "depth"};
  s.tone.exposure = -1.0f / 3;
  s.stop.target_error = 1.5;
  s.tone.tonemap = render::Tonemap::kReinhard;
  Settings copy;
  for (const Setting& setting : settings_table()) {
    const std::vector<std::string> texts = setting.show(s);
    if (!texts.empty()) {
      EXPECT_EQ(setting.assign(copy, texts), std::nullopt) << setting.name;
    }
    EXPECT_EQ(setting.show(copy), texts) << setting.name;
  }
  EXPECT_EQ(copy.render.radius, s.render.radius);
  EXPECT_EQ(copy.render.alpha, s.render.alpha);
  EXPECT_EQ(copy.render.direct, s.render.direct);
  EXPECT_EQ(copy.render.caustics, std::nullopt);
  EXPECT_EQ(copy.tone.exposure, s.tone.exposure);
  EXPECT_EQ(copy.stop.target_error, s.stop.target_error);
  EXPECT_EQ(copy.tone.tonemap, s.tone.tonemap);
}

TEST(SettingsTable, ErrorsNameTheNearestValueAndChangeNothing) {
  Settings s;
  const auto complaint = assign(s, "kernel", {"cones"});
  ASSERT_TRUE(complaint.has_value());
  EXPECT_THAT(*complaint, HasSubstr("`cones`"));
  EXPECT_THAT(*complaint, HasSubstr("did you mean `cone`"));
  EXPECT_TRUE(assign(s, "photons", {"0"}).has_value());
  EXPECT_TRUE(assign(s, "photons", {"-5"}).has_value());
  EXPECT_TRUE(assign(s, "radius", {"0"}).has_value());
  EXPECT_TRUE(assign(s, "radius", {"automatic"}).has_value());
  EXPECT_TRUE(assign(s, "cone-k", {"0.9"}).has_value());
  EXPECT_TRUE(assign(s, "target-error", {"5"}).has_value());
  EXPECT_TRUE(assign(s, "target-error", {"0%"}).has_value());
  EXPECT_TRUE(assign(s, "exposure", {"65"}).has_value());
  EXPECT_TRUE(assign(s, "exposure", {"nan"}).has_value());
  EXPECT_TRUE(assign(s, "exposure", {"Auto"}).has_value());
  EXPECT_TRUE(assign(s, "adaptive", {"-1"}).has_value());
  EXPECT_TRUE(assign(s, "adaptive", {"101"}).has_value());
  EXPECT_TRUE(assign(s, "adaptive", {"nan"}).has_value());
  EXPECT_TRUE(assign(s, "alpha", {"0"}).has_value());
  EXPECT_TRUE(assign(s, "alpha", {"1.01"}).has_value());
  EXPECT_TRUE(assign(s, "crop", {"5", "5", "0", "9"}).has_value());
  EXPECT_TRUE(assign(s, "crop", {"-1", "5", "0", "9"}).has_value());
  EXPECT_TRUE(assign(s, "aov", {"direct,dept"}).has_value());
  EXPECT_TRUE(assign(s, "max-bounces", {"65536"}).has_value());
  const Settings untouched;
  EXPECT_EQ(s.render.kernel, untouched.render.kernel);
  EXPECT_EQ(s.render.photons, untouched.render.photons);
  EXPECT_EQ(s.render.radius, untouched.render.radius);
  EXPECT_TRUE(s.render.crop.empty());
  EXPECT_TRUE(s.render.aov.empty());
}

}  // namespace
}  // namespace kaustik::app
