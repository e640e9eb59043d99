// Tests files of photon maps: the photons that were written come back, and damaged files are refused.

#include "render/map_files/map_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "render/passes/pass_trials.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/file_size_limit.h"

namespace kaustik::render {
namespace {

using namespace test;
using ::testing::HasSubstr;

class MapFiles : public ::testing::Test {
 protected:
  MapFiles() {
    settings_.photons = 4000;
    settings_.direct = DirectEstimator::kLecture;
    settings_.caustics = CausticEstimator::kPhotons;
    settings_.indirect = IndirectEstimator::kPhotons;
    const EstimatorPlan plan = make_plan(settings_, scene_.needs);
    const accel::Bvh bvh(scene_, 1);
    const FirstPhotons first = shoot_first({scene_, bvh, settings_, plan}, {});
    photons_ = first.photons.keep(first.statistics);
    manifest_.build = "0.1.0 (abc)";
    manifest_.isa = "AVX2";
    manifest_.scene_path = "/scenes/\"quoted\" \xc3\xa9.pbrt";
    manifest_.scene_hash = "0123";
    manifest_.settings = {{"photons", {"4000"}}, {"look-at", {"1", "2", "3", "0", "0", "0", "0", "1", "0"}}};
    manifest_.kinds = kinds_needed(plan);
    manifest_.under_glossy = true;
    write_map_file(file_, manifest_, photons_);
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& text) const {
    std::filesystem::remove(file_);
    std::ofstream(file_, std::ios::binary) << text;
  }
  // Why the file is refused; empty if it is not.
  std::string complaint() const {
    try {
      const MapFile file(file_);
      file.open();
      file.check_columns();
    } catch (const MapFileError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file_));
      return error.what();
    }
    return {};
  }
  static std::vector<std::span<const std::byte>> arrays(const photon::PhotonMapParts& p) {
    return {std::as_bytes(p.columns.span()), std::as_bytes(p.nodes.span()), std::as_bytes(p.entries.span()),
            std::as_bytes(p.boxes.span()), std::as_bytes(p.surfaces.span())};
  }
  // Whether the file has these photons.
  static void expect_equal(const KeptPhotons& a, const KeptPhotons& b) {
    for (size_t k = 0; k < photon::kPhotonKinds; ++k) {
      const photon::PhotonMapParts p = a.maps[k].parts(), q = b.maps[k].parts();
      EXPECT_EQ(p.size, q.size);
      EXPECT_EQ(p.flux_unit, q.flux_unit);
      EXPECT_EQ(p.cube, q.cube);
      for (size_t i = 0; i < arrays(p).size(); ++i)
        EXPECT_TRUE(std::ranges::equal(arrays(p)[i], arrays(q)[i])) << "kind " << k << " array " << i;
    }
  }

  const std::string file_ = output_file(
      std::string("map_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".kmap");
  // With every kind of photon.
  static Scene foggy_box() {
    Scene scene = cornell_with_table(8);
    fill(scene, Rgb(0.1f), Rgb(0.2f));
    return scene;
  }
  const Scene scene_ = foggy_box();
  RenderSettings settings_;
  KeptPhotons photons_;
  MapManifest manifest_;
};

TEST_F(MapFiles, KeepEverything) {
  const MapFile file(file_);
  EXPECT_EQ(file.manifest().build, manifest_.build);
  EXPECT_EQ(file.manifest().isa, manifest_.isa);
  EXPECT_EQ(file.manifest().scene_path, manifest_.scene_path);
  EXPECT_EQ(file.manifest().scene_hash, manifest_.scene_hash);
  EXPECT_EQ(file.manifest().settings, manifest_.settings);
  EXPECT_TRUE(file.manifest().under_glossy);
  EXPECT_FALSE(file.manifest().shadow_behind_specular);
  EXPECT_TRUE(file.manifest().kinds.shadow);
  const KeptPhotons opened = file.open();
  file.check_columns();
  expect_equal(opened, photons_);
  EXPECT_GT(opened.maps[size_t(photon::PhotonKind::kCaustic)].size(), 100u);
  EXPECT_EQ(opened.radii, photons_.radii);
  EXPECT_EQ(opened.statistics.photons.stored, photons_.statistics.photons.stored);
  EXPECT_EQ(opened.statistics.guided.emitted, photons_.statistics.guided.emitted);
  EXPECT_EQ(opened.statistics.photons.energy.absorbed, photons_.statistics.photons.energy.absorbed);
}

// The photons outlive the object that opened them, and the file's name.
TEST_F(MapFiles, PhotonsStayWhileTheyAreUsed) {
  const KeptPhotons opened = MapFile(file_).open();
  std::filesystem::remove(file_);
  expect_equal(opened, photons_);
}

TEST_F(MapFiles, ABrokenBitIsFoundOrChangesNothing) {
  const std::string whole = bytes();
  size_t unseen = 0;
  for (size_t at = 0; at < whole.size(); at += 97) {
    std::string broken = whole;
    broken[at] = char(broken[at] ^ (1 << at % 8));
    write(broken);
    if (!complaint().empty()) continue;
    ++unseen;  // between two arrays
    expect_equal(MapFile(file_).open(), photons_);
  }
  // Arrays begin at multiples of 4096 bytes, so 2048 are unused before each, on average.
  EXPECT_LT(unseen * 97, 4096u * (5 * photon::kPhotonKinds + 1));
}

TEST_F(MapFiles, TruncatedFilesAreRefused) {
  const std::string whole = bytes();
  for (const size_t size : {size_t(0), size_t(7)}) {
    write(whole.substr(0, size));
    EXPECT_THAT(complaint(), HasSubstr("not a photon map of kaustik")) << size;
  }
  for (const size_t size :
       {size_t(8), size_t(47), size_t(48), size_t(500), whole.size() / 2, whole.size() - 1}) {
    write(whole.substr(0, size));
    EXPECT_THAT(complaint(), HasSubstr("truncated")) << size;
  }
  write(whole + "x");
  EXPECT_THAT(complaint(), HasSubstr("its size does not match its photons"));
}

TEST_F(MapFiles, FilesOfOtherKindsAreRefused) {
  write("LookAt 0 0 0 0 0 1 0 1 0\n");
  EXPECT_THAT(complaint(), HasSubstr("not a photon map of kaustik"));
  write_map_file(file_, manifest_, photons_);
  std::string other = bytes();
  other[8] = 9;
  write(other);
  EXPECT_THAT(complaint(), HasSubstr("version 9 of the format; this program reads version 1"));
  std::filesystem::remove(file_);
  EXPECT_THAT(complaint(), HasSubstr("No such file"));
  std::filesystem::create_directory(file_);
  EXPECT_THAT(complaint(), HasSubstr("not a regular file"));
  std::filesystem::remove(file_);
}

TEST_F(MapFiles, AFailedWriteLeavesThePreviousFile) {
  const std::string whole = bytes();
  {
    const FileSizeLimit limit(20000);
    EXPECT_THROW(write_map_file(file_, manifest_, photons_), MapFileError);
  }
  EXPECT_TRUE(bytes() == whole);
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(file_).parent_path()))
    EXPECT_EQ(entry.path().filename().string().find(".partial"), std::string::npos) << entry.path();
}

// Photons of a file give the picture of photons that were shot.
TEST_F(MapFiles, PicturesAreThoseOfTheSamePhotons) {
  settings_.spp = 4;
  const RenderResult own = render_with_threads(scene_, settings_);
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      const accel::Bvh bvh(scene_, 1);
      const EstimatorPlan plan = make_plan(settings_, scene_.needs);
      auto first = std::make_shared<FirstPhotons>();
      first->photons.adopt({scene_, bvh, settings_, plan}, MapFile(file_).open(), true, &first->statistics);
      const RenderResult kept = render::render(scene_, bvh, settings_, {}, {.photons = first});
      for (int y = 0; y < own.film.height(); ++y)
        for (int x = 0; x < own.film.width(); ++x)
          EXPECT_EQ(std::memcmp(&own.film.at(x, y), &kept.film.at(x, y), sizeof(PixelResult)), 0);
      EXPECT_EQ(kept.statistics.gather_candidates, own.statistics.gather_candidates);
      EXPECT_EQ(kept.statistics.photons.emitted, own.statistics.photons.emitted);
    });
  }
}

}  // namespace
}  // namespace kaustik::render
