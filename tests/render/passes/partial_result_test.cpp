// Tests partial results on disk: everything is stored, and damaged files are refused.

#include "render/passes/partial_result.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/files/content_hash.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/system_faults.h"

namespace kaustik::render {
namespace {

using namespace test;
using ::testing::HasSubstr;

// The test has an empty folder of its own.
class PartialFile : public ::testing::Test {
 protected:
  PartialFile() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = output_file(std::string("partial_") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    file_ = folder_ + "/a.kpart";
  }

  static PartialResult example() {
    PartialResult part;
    part.manifest.build = "0.1.0 (abc)";
    part.manifest.isa = "AVX2";
    part.manifest.scene_path = "/scenes/\"quoted\" \xc3\xa9.pbrt";
    part.manifest.scene_hash = "0123";
    part.manifest.settings = {{"spp", {"4"}}, {"crop", {"1", "4", "0", "2"}}, {"seed", {"0"}}};
    part.manifest.presentation = {{"aov", {"direct", "depth"}}};
    part.manifest.outputs = {"/out/a.exr"};
    part.manifest.goal = PassSet(0, 8);
    part.manifest.needs = {.specular = true, .any_light = true};
    part.sums.passes = PassSet(0, 3);
    part.sums.passes.add(PassSet(5, 6));
    part.sums.shares = 8;
    part.sums.radii = {0.1f, 1e-20f, 3e10f};
    FilmSums film(3, 2, 1, 0, 8, 8);
    film.at(2, 1) = {.direct = {1, 2e-9, 3e5}, .normal = {-1, 0, 0.5}, .depth = 7, .photons = 9, .count = 4};
    part.sums.totals = FilmTotals(window_of<PixelTotals>(film), {-60, -50, -70});
    part.sums.totals.add(film);
    RenderStatistics& s = part.sums.statistics;
    s.photons.emitted = ~uint64_t{0};
    s.photons.stored = {1, 2, 3, 4};
    s.rays.shadow = 5;
    s.dropped_examples = {{.y = 1, .x = 2, .sample = uint64_t{1} << 40}};
    s.render_s = 0.1;
    return part;
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }
  // Replaces a part of the manifest and corrects its size and the checksum.
  void forge(const std::string& honest, const std::string& claim) const {
    std::string forged = bytes();
    const size_t at = forged.find(honest);
    ASSERT_NE(at, std::string::npos) << honest;
    forged.replace(at, honest.size(), claim);
    uint64_t manifest = 0;
    std::memcpy(&manifest, &forged[16], sizeof manifest);
    manifest += claim.size() - honest.size();
    std::memcpy(&forged[16], &manifest, sizeof manifest);
    ContentHash hash;
    hash.add(std::string_view(forged).substr(0, forged.size() - 16));
    const auto words = hash.words();
    std::memcpy(forged.data() + forged.size() - 16, words.data(), 16);
    write(forged);
  }
  // The error message for the file; empty when it can be read.
  std::string complaint() const {
    try {
      read_partial(file_);
    } catch (const PartialError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file_));
      return error.what();
    }
    return {};
  }

  std::string folder_, file_;
};

TEST_F(PartialFile, KeepsEverything) {
  const PartialResult part = example();
  write_partial(file_, part.manifest, part.sums);
  const PartialResult back = read_partial(file_);
  EXPECT_EQ(difference(part, back), "");
  EXPECT_EQ(back.manifest.scene_path, part.manifest.scene_path);
  EXPECT_EQ(back.manifest.presentation, part.manifest.presentation);
  EXPECT_EQ(back.manifest.outputs, part.manifest.outputs);
  EXPECT_EQ(back.manifest.goal, part.manifest.goal);
  EXPECT_TRUE(back.manifest.needs.specular && back.manifest.needs.any_light);
  EXPECT_FALSE(back.manifest.needs.diffuse);
  EXPECT_EQ(back.sums.passes, part.sums.passes);
  EXPECT_EQ(back.sums.shares, part.sums.shares);
  EXPECT_EQ(back.sums.radii, part.sums.radii);
  EXPECT_EQ(back.sums.totals.units(), part.sums.totals.units());
  const auto &a = part.sums.totals.pixels(), &b = back.sums.totals.pixels();
  EXPECT_EQ(b.x0(), 1);
  EXPECT_EQ(b.full_width(), 8);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(a.at(x, y), b.at(x, y));
  EXPECT_EQ(back.sums.statistics.photons.emitted, ~uint64_t{0});
  EXPECT_EQ(back.sums.statistics.photons.stored, part.sums.statistics.photons.stored);
  EXPECT_EQ(back.sums.statistics.rays.shadow, 5u);
  EXPECT_EQ(back.sums.statistics.dropped_examples, part.sums.statistics.dropped_examples);
  EXPECT_EQ(back.sums.statistics.render_s, 0.1);
  EXPECT_EQ(back.sums.statistics.passes, 4u);
  EXPECT_EQ(back.sums.statistics.radius, 3e10f);
}

TEST_F(PartialFile, KeepsHalves) {
  PartialResult part = example();
  EXPECT_FALSE(part.sums.totals.has_halves());
  FilmSums film(3, 2, 1, 0, 8, 8);
  film.at(2, 1) = {.direct = {1, 2, 3}, .count = 4};
  part.sums.totals = FilmTotals(window_of<PixelTotals>(film), {-60, -50, -70});
  part.sums.totals.keep_halves();
  part.sums.totals.add_as_half(film);
  write_partial(file_, part.manifest, part.sums);
  const PartialResult back = read_partial(file_);
  EXPECT_EQ(difference(part, back), "");
  ASSERT_TRUE(back.sums.totals.has_halves());
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      EXPECT_EQ(back.sums.totals.half_pixels().at(x, y), part.sums.totals.half_pixels().at(x, y));
  EXPECT_EQ(back.sums.totals.half_pixels().at(2, 1).weight, 4);
  EXPECT_THAT(difference(example(), back), HasSubstr("halves"));
}

// Flips bytes in the header, the manifest, the sums and the checksum.
TEST_F(PartialFile, EveryFlippedByteIsFound) {
  const PartialResult part = example();
  write_partial(file_, part.manifest, part.sums);
  const std::string whole = bytes();
  for (size_t at = 0; at < whole.size(); at += at < 32 ? 1 : 7) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
    write(damaged);
    EXPECT_NE(complaint(), "") << at;
  }
  write(whole);
  EXPECT_EQ(complaint(), "");
}

TEST_F(PartialFile, TruncatedAndForeignFilesAreRefusedByName) {
  const PartialResult part = example();
  write_partial(file_, part.manifest, part.sums);
  const std::string whole = bytes();
  for (const size_t size : {size_t{20}, size_t{39}, size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write(whole.substr(0, size));
    EXPECT_THAT(complaint(), HasSubstr("truncated")) << size;
  }
  write(whole + "x");
  EXPECT_NE(complaint(), "");
  for (const std::string& text : {std::string(), std::string("KPART"), std::string(1000, 'x')}) {
    write(text);
    EXPECT_THAT(complaint(), HasSubstr("not a partial result"));
  }
  std::string newer = whole;
  ++newer[8];
  write(newer);
  EXPECT_THAT(complaint(), HasSubstr("version 4 of the format"));
  std::filesystem::remove(file_);
  EXPECT_THAT(complaint(), HasSubstr("No such file"));
  std::filesystem::create_directory(file_);
  EXPECT_NE(complaint(), "");
}

// A manifest that claims the largest image, in a file with a valid checksum, is refused by the file's size
// before memory is allocated.
TEST_F(PartialFile, ClaimsAreCheckedAgainstTheFilesSize) {
  PartialResult part = example();
  part.sums.totals =
      FilmTotals(PixelWindow<PixelTotals>(10000, 1, 0, 0, 65535, 65535), part.sums.totals.units());
  write_partial(file_, part.manifest, part.sums);
  forge("\"width\": 10000,", "\"width\": 65535,");
  EXPECT_THAT(complaint(), HasSubstr("size"));
}

// A file without passes has no pixels that its claims could be checked against, and needs none in memory.
TEST_F(PartialFile, WithoutPassesClaimsTakeNoMemory) {
  PartialResult none = example();
  none.sums.passes = {};
  write_partial(file_, none.manifest, none.sums);
  forge("\"width\": 3,", "\"width\": 65535,"), forge("\"height\": 2,", "\"height\": 65535,");
  forge("\"x0\": 1,", "\"x0\": 0,");
  forge("\"full_width\": 8,", "\"full_width\": 65535,");
  forge("\"full_height\": 8", "\"full_height\": 65535");
  none = read_partial(file_);
  EXPECT_TRUE(none.sums.totals.pixels().all().empty());
  // It can be merged in either order.
  const PartialResult part = example();
  EXPECT_EQ(difference(none, part), "");
  PassSums first = none.sums, second = part.sums;
  first.add(part.sums), second.add(none.sums);
  for (const PassSums& sums : {first, second}) {
    EXPECT_EQ(sums.passes, part.sums.passes);
    EXPECT_EQ(sums.totals.pixels().at(2, 1), part.sums.totals.pixels().at(2, 1));
  }
}

// The JSON library would turn 2^32 + 3 into a width of 3 and -5 into 2^64 - 5.
TEST_F(PartialFile, NumbersThatAreNoCountsAreRefusedByName) {
  const std::array<std::array<std::string, 3>, 8> claims = {{{"width", "3", "4294967299"},
                                                             {"width", "3", "3.5"},
                                                             {"y0", "0", "-4294967296"},
                                                             {"shadow_rays", "5", "-5"},
                                                             {"shadow_rays", "5", "1e30"},
                                                             {"absorbed", "0", "18446744073709551615"},
                                                             {"direct_nearest", "0", "4294967296"},
                                                             {"passes_of_settings", "8", "-8"}}};
  const PartialResult part = example();
  for (const auto& [key, honest, claim] : claims) {
    write_partial(file_, part.manifest, part.sums);
    forge(fmt::format("\"{}\": {}", key, honest), fmt::format("\"{}\": {}", key, claim));
    EXPECT_THAT(complaint(), HasSubstr(fmt::format("\"{}\": expected a whole number", key))) << claim;
  }
  write_partial(file_, part.manifest, part.sums);
  forge("1099511627776", "-1");
  EXPECT_THAT(complaint(), HasSubstr("\"dropped_examples\": expected a whole number"));
}

TEST_F(PartialFile, FailedWriteKeepsThePreviousFile) {
  const PartialResult part = example();
  write_partial(file_, part.manifest, part.sums);
  {
    test::SystemFaults faults;
    faults.fail(SystemCall::kRename, 1, EIO);
    EXPECT_THROW(write_partial(file_, part.manifest, part.sums), PartialError);
  }
  EXPECT_EQ(complaint(), "");
  EXPECT_THROW(write_partial(folder_ + "/none/a.kpart", part.manifest, part.sums), PartialError);
}

TEST(PartialDifference, NamesTheSettingsThatDiffer) {
  PartialResult a;
  a.manifest.settings = {{"seed", {"0"}}};
  const auto differing = [&](auto change) {
    PartialResult b = a;
    change(b);
    return difference(a, b);
  };
  EXPECT_EQ(differing([](PartialResult& b) { b.manifest.presentation = {{"threads", {"2"}}}; }), "");
  EXPECT_THAT(differing([](PartialResult& b) { b.manifest.scene_hash = "1"; }), HasSubstr("scenes"));
  EXPECT_THAT(differing([](PartialResult& b) { b.manifest.settings[0].second = {"1"}; }),
              HasSubstr("--seed: 0 and 1"));
  EXPECT_THAT(differing([](PartialResult& b) { b.manifest.settings.clear(); }),
              HasSubstr("--seed: 0 and unset"));
  EXPECT_THAT(differing([](PartialResult& b) {
                b.manifest.settings.push_back({"crop", {"1", "2", "3", "4"}});
              }),
              HasSubstr("--crop: unset and 1 2 3 4"));
  EXPECT_THAT(differing([](PartialResult& b) { b.manifest.build = "x"; }), HasSubstr("programs"));
  EXPECT_THAT(differing([](PartialResult& b) { b.manifest.isa = "x"; }), HasSubstr("instruction sets"));
}

}  // namespace
}  // namespace kaustik::render
