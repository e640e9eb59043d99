// Every call by which a command opens, reads, writes, names or maps a file fails once. The exit code then is
// not 0, or all outputs are there; each output is the file from before or the complete new one; and no
// temporary file is left.

#include <gmock/gmock.h>

#include <cerrno>
#include <map>
#include <nlohmann/json.hpp>

#include "render/passes/partial_result.h"
#include "tests/apps/support/program.h"
#include "tests/support/system_faults.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOld = "the file from before";

class FileFaults : public ProgramTest {
 protected:
  using Files = std::map<std::string, std::string>;

  // All files below `folder` with their contents.
  Files contents(const std::string& folder) const {
    Files out;
    for (const auto& entry : fs::recursive_directory_iterator(path(folder))) {
      if (!entry.is_regular_file()) continue;
      const std::string name = fs::relative(entry.path(), path("")).string();
      out[name] = read(name);
    }
    return out;
  }

  // An empty folder `out` with the files from before.
  void prepare(const std::vector<std::string>& old) const {
    fs::remove_all(path("out"));
    fs::create_directory(path("out"));
    for (const std::string& name : old) write("out/" + name, kOld);
  }

  // Runs the command with each call failing in turn until one is not reached. `replaced`: outputs that exist
  // before. Times differ from run to run, so of some files only completeness is compared.
  void expect_survives(const std::vector<std::string>& command,
                       const std::vector<std::string>& replaced = {}) {
    prepare({});
    const Outcome good = run_kaustik(command);
    ASSERT_EQ(good.code, 0) << good.err;
    const Files expected = contents("out");
    ASSERT_FALSE(expected.empty());
    for (int n = 1;; ++n) {
      prepare(replaced);
      SystemFaults faults;
      faults.fail_call(n, n % 2 == 0 ? ENOSPC : EIO);
      const Outcome outcome = run_kaustik(command);
      const bool failed = faults.happened();
      faults.stop();
      const Files found = contents("out");
      SCOPED_TRACE(::testing::Message()
                   << "call " << n << ", exit code " << outcome.code << ", " << outcome.err);
      expect_whole(found, expected, outcome.code == 0);
      if (HasFailure()) return;
      if (failed) continue;
      EXPECT_EQ(outcome.code, 0);
      EXPECT_GT(n, 3);
      RecordProperty("calls", n - 1);
      return;
    }
  }

 private:
  bool is_complete(const std::string& name, const std::string& bytes, const std::string& expected) const {
    if (bytes == expected) return true;
    const std::string extension = fs::path(name).extension().string();
    if (extension == ".json") return nlohmann::json::accept(bytes);
    if (extension == ".html") return bytes.ends_with("</html>\n");
    if (extension == ".kpart") return render::read_partial(path(name)).sums.passes.count() > 0;  // throws
    // Tables of times.
    if (extension == ".csv") return std::ranges::count(bytes, '\n') == std::ranges::count(expected, '\n');
    return false;
  }

  void expect_whole(const Files& found, const Files& expected, bool done) const {
    for (const auto& [name, bytes] : found) {
      ASSERT_TRUE(expected.contains(name)) << name << " is left";
      if (bytes == kOld)
        EXPECT_FALSE(done) << name << " was not replaced";
      else
        EXPECT_TRUE(is_complete(name, bytes, expected.at(name))) << name << " is incomplete";
    }
    if (!done) return;
    for (const auto& [name, bytes] : expected) EXPECT_TRUE(found.contains(name)) << name << " is missing";
  }
};

TEST_F(FileFaults, Render) {
  expect_survives({"render",
                   small_scene(film(12, 8)),
                   "--spp",
                   "4",
                   "--passes",
                   "2",
                   "--photons",
                   "200",
                   "-q",
                   "--threads",
                   "2",
                   "-o",
                   path("out/a.exr"),
                   "-o",
                   path("out/a.png"),
                   "-o",
                   path("out/a.jpg"),
                   "-o",
                   path("out/a.kpart"),
                   "--stats",
                   path("out/a.json"),
                   "--checkpoint",
                   path("out/c.kpart"),
                   "--checkpoint-every",
                   "1ms"},
                  {"a.exr", "a.png", "a.jpg", "a.kpart", "a.json", "c.kpart"});
}

TEST_F(FileFaults, ResumeAndMerge) {
  const std::string scene = small_scene(film(12, 8));
  for (const std::string range : {"0:1", "1:2"})
    ASSERT_EQ(run_kaustik({"render", scene, "--spp", "4", "--passes", "2", "--photons", "200", "-q",
                           "--pass-range", range, "-o", path(range.substr(0, 1) + ".kpart")})
                  .code,
              0);
  expect_survives(
      {"merge", path("0.kpart"), path("1.kpart"), "-q", "-o", path("out/a.exr"), "-o", path("out/b.kpart")},
      {"a.exr", "b.kpart"});
  expect_survives({"resume", path("0.kpart"), "--pass-range", "0:1", "--checkpoint", path("out/c.kpart"),
                   "-q", "-o", path("out/a.exr")},
                  {"a.exr", "c.kpart"});
}

TEST_F(FileFaults, KeptMaps) {
  const std::string scene = small_scene(film(12, 8));
  expect_survives({"shoot", scene, "--photons", "500", "-q", "-o", path("out/a.kmap")}, {"a.kmap"});
  fs::copy(path("out/a.kmap"), path("kept.kmap"));
  expect_survives({"render", scene, "--photons", "500", "--spp", "1", "-q", "--map", path("kept.kmap"), "-o",
                   path("out/a.exr")},
                  {"a.exr"});
}

TEST_F(FileFaults, Photons) {
  expect_survives({"photons", small_scene(film(12, 8)), "--photons", "500", "-q", "-o", path("out/a.ply"),
                   "--image", path("out/a.png")},
                  {"a.ply", "a.png"});
}

TEST_F(FileFaults, Convert) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_survives({"convert", path("a.obj"), path("out/a.pbrt"), "-q"}, {"a.pbrt"});
}

TEST_F(FileFaults, CompareAndDenoise) {
  const std::string scene = small_scene(film(40, 30));
  ASSERT_EQ(run_kaustik({"render", scene, "--spp", "1", "--photons", "200", "-q", "--aov", "denoising", "-o",
                         path("a.exr")})
                .code,
            0);
  expect_survives({"compare", path("a.exr"), path("a.exr"), "--heatmap", path("out/h.png")}, {"h.png"});
  expect_survives({"denoise", path("a.exr"), "-q", "-o", path("out/d.exr"), "-o", path("out/d.png")},
                  {"d.exr", "d.png"});
}

TEST_F(FileFaults, Bench) {
  expect_survives({"bench", small_scene(film(12, 8)), "--photons", "200", "--spp", "1", "--threads", "1",
                   "--repeat", "1", "-q", "--json", path("out/a.json"), "--plot", path("out/plot")},
                  {"a.json"});
}

TEST_F(FileFaults, Sweep) {
  const std::string scene = small_scene(film(12, 8));
  ASSERT_EQ(run_kaustik({"render", scene, "--spp", "1", "--photons", "100", "-q", "-o", path("r.exr")}).code,
            0);
  expect_survives({"sweep", scene, "--photons", "100", "--radius", "auto", "--spp", "1", "--seeds", "1",
                   "--reference", path("r.exr"), "-q", "-o", path("out/s")});
}

}  // namespace
}  // namespace kaustik::test
