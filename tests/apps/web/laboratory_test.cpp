// The laboratory of the live page: whose photons it shows, and which settings it takes.

#include "apps/web/laboratory.h"

#include <gmock/gmock.h>

#include <cstring>
#include <future>

#include "tests/render/support/test_scenes.h"

namespace kaustik::app {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class LaboratoryTest : public ::testing::Test {
 protected:
  LaboratoryTest() { laboratory_.begin(); }

  static Settings settings_of(uint64_t photons, uint64_t passes = 1) {
    Settings settings;
    settings.render.method = render::Method::kPhoton;
    settings.render.photons = photons;
    settings.render.passes = passes;
    return settings;
  }
  HttpResponse get(const std::string& path) { return *extension_.answer({"GET", path, {}, {}, {}, {}, {}}); }
  HttpResponse render_with(const Json& settings) {
    return *extension_.answer({"POST", "/render", settings.dump(), {}, {}, {}, {}});
  }
  uint32_t photons() {
    uint32_t count = 0;
    std::memcpy(&count, get("/photons").body.data(), sizeof(count));
    return count;
  }
  std::string value(const std::string& name) const {
    const auto described = extension_.describe();
    for (const auto& setting : described["settings"])
      if (setting["name"] == name) return setting["value"];
    return "there is none";
  }

  // Take many seconds to shoot.
  static constexpr uint64_t kMany = 30'000'000;

  Scene scene_ = test::cornell_with_table(32);
  accel::Bvh bvh_{scene_, 2};
  Laboratory laboratory_{scene_, bvh_, settings_of(20'000)};
  std::vector<Settings> wanted_;
  PageExtension extension_ = laboratory_.extension(
      [this](const SettingOverrides&, const Settings& settings) { wanted_.push_back(settings); });
};

TEST_F(LaboratoryTest, ShowsThePhotonsOfOnePass) {
  laboratory_.settle(settings_of(20'000));
  const uint32_t all = photons();
  EXPECT_GT(all, 10'000u) << "most photons are stored more than once";
  laboratory_.begin();
  laboratory_.settle(settings_of(20'000, 10));
  // Of a tenth of the paths; the variance of their number is below that of the stored photons times bounces.
  EXPECT_NEAR(photons(), all / 10.0, 10 * std::sqrt(all));
}

TEST_F(LaboratoryTest, PhotonsOfOlderSettingsAreNotShown) {
  laboratory_.settle(settings_of(kMany));
  auto answer = std::async(std::launch::async, [&] { return photons(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  laboratory_.begin();
  EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout)
      << "there are no photons until the settings are known";
  laboratory_.settle(settings_of(1'000));
  EXPECT_LT(answer.get(), 10'000u);
}

TEST_F(LaboratoryTest, TheEndWaitsForNothing) {
  auto before = std::async(std::launch::async, [&] { return photons(); });
  laboratory_.settle(settings_of(kMany));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  laboratory_.end();
  EXPECT_THROW(before.get(), std::runtime_error);
}

TEST_F(LaboratoryTest, SettingsAddUp) {
  EXPECT_EQ(render_with({{"photons", "30000"}}).status, 202);
  EXPECT_EQ(render_with({{"radius", "0.5x"}}).status, 202);
  ASSERT_EQ(wanted_.size(), 2u);
  EXPECT_EQ(wanted_[1].render.photons, 30'000u);
  EXPECT_EQ(value("photons"), "30000");
  EXPECT_EQ(value("radius"), "0.5x");
  // Nothing stands for the default.
  EXPECT_EQ(render_with({{"radius", ""}, {"photons", ""}}).status, 202);
  EXPECT_EQ(value("radius"), "auto");
  EXPECT_EQ(wanted_[2].render.photons, Settings{}.render.photons);
}

TEST_F(LaboratoryTest, RefusesWhatCannotBeRendered) {
  EXPECT_EQ(render_with({{"photons", "1000000000G"}}).status, 400);
  EXPECT_EQ(render_with({{"output", "/etc/passwd"}}).status, 400);
  const HttpResponse wrong = render_with({{"node-photons", "many"}});
  EXPECT_EQ(wrong.status, 400);
  EXPECT_THAT(wrong.body, HasSubstr("--node-photons: "));
  EXPECT_TRUE(wanted_.empty());
  EXPECT_EQ(value("photons"), "20000") << "and keeps what there was";
}

TEST_F(LaboratoryTest, EstimatesNeedAPixel) {
  laboratory_.settle(settings_of(20'000));
  const auto estimate = [&](const std::string& x, const std::string& y) {
    return *extension_.answer({"GET", "/estimate", {}, {{"x", x}, {"y", y}}, {}, {}, {}});
  };
  const Json found = Json::parse(estimate("16", "12").body);
  EXPECT_EQ(found["maps"][0]["use"], "added");
  EXPECT_GT(found["maps"][0]["accepted"], 0);
  for (const char* x : {"", "-1", "32", "abc", "1e1", "99999999999999999999"})
    EXPECT_EQ(estimate(x, "0").status, 400) << x;
}

}  // namespace
}  // namespace kaustik::app
