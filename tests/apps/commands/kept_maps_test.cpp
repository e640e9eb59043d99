// Tests kept photon maps from the outside: pictures from a file are those of the render that shot by itself,
// byte for byte, and maps that do not belong to a render are refused.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/apps/support/program.h"
#include "tests/support/file_size_limit.h"

namespace kaustik::app {
namespace {

using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;
using ::testing::Not;

using Arguments = std::vector<std::string>;

class KeptMapFiles : public test::ProgramTest {
 protected:
  Outcome run(const std::string& command, Arguments more, const std::string& scene) const {
    more.insert(more.begin(), {command, scene});
    return run_kaustik(more);
  }
  Outcome render(Arguments more) const {
    more.insert(more.end(), {"--spp", "4"});
    return run("render", more, scene_);
  }
  Outcome shoot(const std::string& name, Arguments more = {}) const {
    more.insert(more.end(), {"-o", path(name), "--photons", "20k"});
    return run("shoot", more, scene_);
  }
  void expect_done(const Outcome& outcome) const { EXPECT_EQ(outcome.code, kDone) << outcome.err; }
  // Expects exit code 2, the text, and no picture.
  void expect_refused(const Outcome& outcome, const std::string& text) const {
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(exists("refused.exr"));
  }
  Outcome refused(Arguments more) const {
    more.insert(more.end(), {"--map", path("a.kmap"), "-o", path("refused.exr")});
    return render(more);
  }

  std::string scene_ = small_scene(film(40, 24));
};

TEST_F(KeptMapFiles, GiveThePictureOfTheRenderThatShotByItself) {
  const std::vector<Arguments> kinds = {
      {}, {"--method", "photon"}, {"--method", "hybrid"}, {"--direct", "signed"}, {"--for-camera", "all"}};
  for (const Arguments& settings : kinds) {
    Arguments own = settings;
    own.insert(own.end(), {"--photons", "20k", "-o", path("own.exr"), "--save-map", path("own.kmap")});
    expect_done(render(own));
    expect_done(shoot("shot.kmap", settings));
    EXPECT_TRUE(read("own.kmap") == read("shot.kmap"));
    expect_done(render({"--map", path("own.kmap"), "-o", path("kept.exr"), "--threads", "1"}));
    EXPECT_TRUE(read("kept.exr") == read("own.exr"));
  }
}

TEST_F(KeptMapFiles, AreTheSameForAnyNumberOfThreads) {
  expect_done(shoot("one.kmap", {"--threads", "1"}));
  expect_done(shoot("three.kmap", {"--threads", "3"}));
  EXPECT_TRUE(read("one.kmap") == read("three.kmap"));
}

// What does not concern the photons may be chosen anew, and has the bits of a render with these settings.
TEST_F(KeptMapFiles, ServeOtherSamplesRadiiAndEstimators) {
  expect_done(shoot("a.kmap"));
  const std::vector<Arguments> settings = {{"--radius", "0.5x"},
                                           {"--radius", "0.1"},
                                           {"--nearest", "50", "--kernel", "cone"},
                                           {"--indirect", "photons"},
                                           {"--crop", "3", "20", "2", "9"}};
  for (Arguments more : settings) {
    Arguments own = more;
    own.insert(own.end(), {"--photons", "20k", "--save-map", path("own.kmap"), "-o", path("own.exr")});
    expect_done(render(own));
    more.insert(more.end(), {"--map", path("a.kmap"), "-o", path("kept.exr")});
    expect_done(render(more));
    EXPECT_TRUE(read("kept.exr") == read("own.exr")) << more[0] << " " << more[1];
  }
}

TEST_F(KeptMapFiles, OfAnyCameraDoNotDependOnIt) {
  expect_done(shoot("a.kmap", {"--for-camera", "all"}));
  const Arguments elsewhere = {"--look-at", "2", "2", "5", "0", "0", "0", "0", "1", "0"};
  Arguments from_elsewhere = elsewhere;
  from_elsewhere.insert(from_elsewhere.end(), {"--for-camera", "all", "--width", "99"});
  expect_done(shoot("b.kmap", from_elsewhere));
  const auto photons = [&](const std::string& name) { return read(name).substr(8192); };
  EXPECT_TRUE(photons("a.kmap") == photons("b.kmap"));
  Arguments more = elsewhere;
  more.insert(more.end(), {"--map", path("a.kmap"), "-o", path("kept.exr")});
  const Outcome outcome = render(more);
  expect_done(outcome);
  EXPECT_THAT(outcome.err, Not(HasSubstr("another camera")));
}

TEST_F(KeptMapFiles, OfAnotherCameraSaySo) {
  expect_done(shoot("a.kmap"));
  const Outcome outcome = render({"--map", path("a.kmap"), "--fov", "50", "-o", path("kept.exr")});
  expect_done(outcome);
  EXPECT_THAT(outcome.err, HasSubstr("was shot for another camera"));
}

TEST_F(KeptMapFiles, AreCountedInTheStatistics) {
  expect_done(render({"--photons", "20k", "-o", path("own.exr"), "--save-map", path("a.kmap"), "--stats",
                      path("own.json")}));
  expect_done(render({"--map", path("a.kmap"), "-o", path("kept.exr"), "--stats", path("kept.json")}));
  const auto own = nlohmann::json::parse(read("own.json")), kept = nlohmann::json::parse(read("kept.json"));
  for (const char* key : {"photons", "rays", "gather", "radii", "settings", "energy", "left_out"})
    EXPECT_EQ(kept[key], own[key]) << key;
}

TEST_F(KeptMapFiles, OfOtherPhotonsAreRefused) {
  expect_done(shoot("a.kmap", {"--seed", "3"}));
  expect_refused(refused({"--photons", "30k"}), "its photons were shot with --photons 20000, not 30000");
  expect_refused(refused({"--seed", "4"}), "its photons were shot with --seed 3, not 4");
  expect_refused(refused({"--sky", "off"}), "its photons were shot with --sky unset, not off");
  expect_refused(
      refused({"--method", "photon"}),
      "photons, but the estimators read direct, caustic, indirect, medium-caustic, medium-indirect photons");
  expect_refused(refused({"--method", "mc"}), "there are no photons to keep");
  expect_refused(refused({"--passes", "4"}), "kept photon maps hold one pass, but the settings ask for 4");
  expect_refused(refused({"--time", "1s"}), "--time and --target-error shoot further photons");
  expect_refused(refused({"--aov", "error"}), "kept photon maps hold one pass");
  expect_refused(refused({"--save-map", path("b.kmap")}), "--save-map");
  expect_refused(refused({"--passes", "1", "--pass-range", "1:2"}), "kept photon maps hold pass 0 alone");
  expect_refused(refused({"--fov", "50", "--checkpoint", path("a.kpart")}), "was shot for other cameras");
}

TEST_F(KeptMapFiles, OfAnotherSceneAreRefused) {
  expect_done(shoot("a.kmap"));
  small_scene(film(40, 24) + "\n# another file");
  expect_refused(refused({}), "whose contents are not those of");
}

TEST_F(KeptMapFiles, ThatAreDamagedAreRefused) {
  expect_done(shoot("a.kmap"));
  const std::string whole = read("a.kmap");
  std::string broken = whole;
  broken[whole.size() - 1] ^= 1;  // in the boxes' surfaces, which lead to photons
  write("a.kmap", broken);
  const Outcome structure = refused({});
  EXPECT_EQ(structure.code, kFailed);
  EXPECT_THAT(structure.err, HasSubstr("the file is damaged: bytes"));
  EXPECT_FALSE(exists("refused.exr"));
  broken = whole;
  broken[8192 + 100] ^= 1;  // in the columns, which are checked while the picture is rendered
  write("a.kmap", broken);
  const Outcome columns = refused({});
  EXPECT_EQ(columns.code, kFailed);
  EXPECT_THAT(columns.err, HasSubstr("the file is damaged: bytes"));
  EXPECT_FALSE(exists("refused.exr"));
  EXPECT_EQ(refused({"--checkpoint", path("refused.kpart"), "--checkpoint-every", "0s"}).code, kFailed);
  EXPECT_FALSE(exists("refused.kpart"));
  write("a.kmap", "nothing");
  expect_refused(refused({}), "not a photon map of kaustik");
}

TEST_F(KeptMapFiles, ThatCannotBeWrittenDoNotCostThePicture) {
  expect_refused(render({"--save-map", path("a.txt"), "-o", path("refused.exr")}), "must end in .kmap");
  expect_refused(render({"--save-map", path("none/a.kmap"), "-o", path("refused.exr")}),
                 "there is no folder");
  expect_refused(run("shoot", {}, scene_), "nothing to write: give -o");
  EXPECT_THAT(shoot("b.kmap", {"--quality", "reference"}).err, HasSubstr("all photons are shot in one pass"));
  const test::FileSizeLimit limit(100000);  // more than the picture, less than the maps
  const Outcome outcome =
      render({"--save-map", path("a.kmap"), "--photons", "200k", "-o", path("a.exr"), "-q"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("a.kmap: File too large"));
  EXPECT_FALSE(exists("a.kmap"));
  EXPECT_TRUE(exists("a.exr"));
}

}  // namespace
}  // namespace kaustik::app
