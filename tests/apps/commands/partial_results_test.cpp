// Tests checkpoints, resume, split and merge from the outside: the files are those of the uninterrupted
// render, byte for byte, and parts that do not belong together are refused.

#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "apps/import/import_scene.h"
#include "render/passes/partial_result.h"
#include "tests/apps/support/child_process.h"
#include "tests/apps/support/program.h"
#include "tests/apps/support/watching.h"

namespace kaustik::app {
namespace {

using test::ChildProcess;
using test::Outcome;
using test::run_kaustik;
using ::testing::HasSubstr;

using Arguments = std::vector<std::string>;

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void sleep_ms(unsigned ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

class PartialResults : public test::ProgramTest {
 protected:
  // Twelve passes with automatic radii that shrink.
  Arguments render(const Arguments& more, const std::string& passes = "12") const {
    return Arguments{"render", scene_,    "--photons", "24k",   "--spp", "12", "--passes",
                     passes,   "--alpha", "0.8",       "--aov", "all",   "-q"} +
           more;
  }
  void expect_done(const Arguments& arguments) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
  }
  // Expects exit code 2 and an error that contains each of `parts`.
  void expect_refused(const Arguments& arguments, const std::vector<std::string>& parts) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine);
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
  }
  void make_parts() const {
    expect_done(render({"--pass-range", "0:3", "-o", path("a.kpart"), "--threads", "1"}));
    expect_done(render({"--pass-range", "3:8", "-o", path("b.kpart"), "--threads", "2"}));
    expect_done(render({"--pass-range", "8:12", "-o", path("c.kpart"), "--threads", "3"}));
  }
  render::PassSet passes_in(const std::string& name) const {
    return render::read_partial(path(name)).sums.passes;
  }

  std::string scene_ = small_scene(film(40, 24));
};

TEST_F(PartialResults, PartsMergedInAnyOrderMatchTheWhole) {
  expect_done(render({"-o", path("whole.exr")}));
  make_parts();
  Arguments order = {path("a.kpart"), path("b.kpart"), path("c.kpart")};
  do {
    expect_done(Arguments{"merge"} + order + Arguments{"-o", path("merged.exr"), "-q"});
    EXPECT_TRUE(read("merged.exr") == read("whole.exr"));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(PartialResults, PartsMergedStepByStepMatchTheWhole) {
  expect_done(render({"-o", path("whole.exr"), "--stats", path("whole.json")}));
  make_parts();
  expect_done({"merge", path("c.kpart"), path("a.kpart"), "--allow-gaps", "-o", path("ac.kpart"), "-q"});
  EXPECT_EQ(passes_in("ac.kpart").text(), "0:3,8:12");
  expect_done({"merge", path("b.kpart"), path("ac.kpart"), "-o", path("merged.exr"), "--stats",
               path("merged.json"), "-q"});
  EXPECT_TRUE(read("merged.exr") == read("whole.exr"));
  const auto merged = nlohmann::json::parse(read("merged.json")),
             whole = nlohmann::json::parse(read("whole.json"));
  for (const char* key : {"photons", "rays", "gather", "radii", "settings", "pass_ranges", "left_out"})
    EXPECT_EQ(merged[key], whole[key]) << key;
  EXPECT_EQ(whole["pass_ranges"], "0:12");
  // A gap can also be filled by rendering it.
  expect_done({"resume", path("ac.kpart"), "-o", path("filled.exr"), "-q"});
  EXPECT_TRUE(read("filled.exr") == read("whole.exr"));
}

TEST_F(PartialResults, ResumingWithOtherThreadsMatchesTheWhole) {
  expect_done(render({"-o", path("whole.exr")}));
  expect_done(render(
      {"-o", path("a.exr"), "--pass-range", "0:5", "--checkpoint", path("a.kpart"), "--threads", "1"}));
  EXPECT_FALSE(read("a.exr") == read("whole.exr"));
  // The picture's name comes from the checkpoint.
  expect_done({"resume", path("a.kpart"), "--passes", "12", "--threads", "3", "-q"});
  EXPECT_TRUE(read("a.exr") == read("whole.exr"));
  EXPECT_EQ(passes_in("a.kpart").text(), "0:12");
}

// A render that will replace a checkpoint says so.
TEST_F(PartialResults, ExistingCheckpointIsReported) {
  const Arguments arguments = render({"-o", path("a.exr"), "--checkpoint", path("a.kpart")});
  EXPECT_EQ(run_kaustik(arguments).err, "");
  EXPECT_THAT(run_kaustik(arguments).err, HasSubstr("a.kpart exists and will be replaced; `kaustik resume`"));
}

// The render gets more passes than were requested, by --pass-range.
TEST_F(PartialResults, RendersCanBeExtended) {
  expect_done(render({"-o", path("a.exr"), "--checkpoint", path("a.kpart")}));
  expect_done({"resume", path("a.kpart"), "--passes", "15", "-q"});
  expect_done(render({"-o", path("b.exr"), "--pass-range", "0:15"}));
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  expect_refused({"resume", path("a.kpart"), "--passes", "14"}, {"a.kpart", "0:15"});
}

// The program is killed at random moments (with fixed seeds), some of them while a checkpoint is written. The
// final picture must be that of the uninterrupted render.
TEST_F(PartialResults, KilledAndResumedMatchesTheWhole) {
  const Arguments settings = {"--photons", "300k", "--spp", "120"};
  expect_done(render(Arguments{"-o", path("whole.exr")} + settings, "60"));
  int cut_short = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::filesystem::remove(path("a.kpart"));
    ChildProcess first(render(Arguments{"-o", path("a.exr"), "--checkpoint", path("a.kpart"),
                                        "--checkpoint-every", "0s", "--threads", "1"} +
                                  settings,
                              "60"));
    while (!exists("a.kpart") && first.running()) sleep_ms(1);
    sleep_ms(random() % 40);
    first.kill(SIGKILL);
    first.wait();
    for (const char* threads : {"2", "1"}) {
      cut_short += passes_in("a.kpart").count() < 60;
      ChildProcess again({"resume", path("a.kpart"), "--checkpoint-every", "0s", "--threads", threads, "-q"});
      sleep_ms(20 + random() % 80);
      again.kill(SIGKILL);
      again.wait();
    }
    expect_done({"resume", path("a.kpart"), "-q"});
    EXPECT_TRUE(read("a.exr") == read("whole.exr")) << "seed " << seed;
  }
  EXPECT_GT(cut_short, 0);  // otherwise the test shows nothing
}

// An interrupt writes the picture of the complete passes and a checkpoint of them.
TEST_F(PartialResults, InterruptWritesTheCompletePasses) {
  std::atomic<bool> stop = false;
  std::thread sender([&] {
    test::wait_until_handled(SIGTERM, stop);
    while (!stop && !exists("a.kpart")) sleep_ms(1);
    if (!stop) std::raise(SIGTERM);
  });
  const Arguments endless = {"--spp", "1000000", "--photons", "1G", "--checkpoint-every", "0s"};
  const Outcome outcome = run_kaustik(
      render(Arguments{"-o", path("a.exr"), "-o", path("b.kpart"), "--checkpoint", path("a.kpart")} + endless,
             "1000000"));
  stop = true;
  sender.join();
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted: the picture shows passes 0:"));
  EXPECT_EQ(passes_in("a.kpart"), passes_in("b.kpart"));
  EXPECT_GT(passes_in("a.kpart").count(), 0u);
  expect_done({"merge", path("a.kpart"), "--allow-gaps", "-o", path("c.exr"), "-q"});
  EXPECT_TRUE(read("a.exr") == read("c.exr"));
}

TEST_F(PartialResults, MismatchedPartsAreNotMerged) {
  make_parts();
  const std::string a = path("a.kpart"), b = path("b.kpart"), c = path("c.kpart"), x = path("x.exr");
  expect_refused({"merge", a, b, c}, {"-o"});
  expect_refused({"merge", a, c, "-o", x}, {"3:8", "--allow-gaps"});
  expect_refused({"merge", b, c, "-o", x}, {"0:3"});
  expect_refused({"merge", a, b, "-o", x}, {"8:12"});
  expect_refused({"merge", a, a, "-o", x}, {"a.kpart", "both hold passes 0:3"});
  const auto other = [&](const Arguments& change) {
    expect_done(render(Arguments{"--pass-range", "3:12", "-o", path("other.kpart")} + change));
    return path("other.kpart");
  };
  expect_refused({"merge", a, other({"--seed", "7"}), "-o", x},
                 {"a.kpart", "other.kpart", "--seed: 0 and 7"});
  expect_refused({"merge", a, other({"--spp", "24"}), "-o", x}, {"--spp: 12 and 24"});
  expect_refused({"merge", a, other({"--crop", "0", "8", "0", "8"}), "-o", x}, {"--crop"});
  std::filesystem::create_directories(path("elsewhere"));
  std::filesystem::copy_file(scene_, path("elsewhere/moved.pbrt"));
  scene_ = path("elsewhere/moved.pbrt");  // a file with the same contents
  expect_done({"merge", a, other({"--aov", "depth", "--exposure", "2"}), "-o", x, "-q"});
  std::ofstream(scene_, std::ios::app) << "# changed\n";
  expect_refused({"merge", a, other({}), "-o", x}, {"a.kpart", "other.kpart", "different scenes"});
}

TEST_F(PartialResults, OtherProgramsAndMachinesAreRefused) {
  expect_done(render({"--pass-range", "0:12", "-o", path("a.kpart")}));
  const render::PartialResult part = render::read_partial(path("a.kpart"));
  render::PartialResult changed = part;
  changed.manifest.build = "9.9.9 (other)";
  render::write_partial(path("b.kpart"), changed.manifest, changed.sums);
  expect_refused({"resume", path("b.kpart")}, {"b.kpart", "9.9.9 (other)"});
  expect_refused({"merge", path("a.kpart"), path("b.kpart"), "-o", path("x.exr")},
                 {"b.kpart", "9.9.9 (other)"});
  changed = part;
  changed.manifest.isa = "ABACUS";
  render::write_partial(path("b.kpart"), changed.manifest, changed.sums);
  expect_refused({"resume", path("b.kpart")}, {"b.kpart", "ABACUS"});
  changed = part;
  changed.manifest.settings.push_back({"sauce", {"extra"}});
  render::write_partial(path("b.kpart"), changed.manifest, changed.sums);
  expect_refused({"resume", path("b.kpart")}, {"b.kpart", "sauce"});
}

TEST_F(PartialResults, DamagedFilesAreRefused) {
  make_parts();
  const std::string whole = read("a.kpart");
  for (const size_t at : {size_t{3}, size_t{30}, whole.size() / 2, whole.size() - 3}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write("a.kpart", damaged);
    expect_refused({"resume", path("a.kpart")}, {"a.kpart"});
    expect_refused({"merge", path("b.kpart"), path("a.kpart"), "-o", path("x.exr")}, {"a.kpart"});
  }
  write("a.kpart", whole.substr(0, whole.size() - 100));
  expect_refused({"resume", path("a.kpart")}, {"a.kpart", "truncated"});
}

TEST_F(PartialResults, ChangedSceneIsNotResumed) {
  expect_done(render({"--pass-range", "0:3", "--checkpoint", path("a.kpart"), "-o", path("a.exr")}));
  std::filesystem::create_directories(path("elsewhere"));
  std::filesystem::copy_file(scene_, path("elsewhere/moved.pbrt"));
  std::ofstream(scene_, std::ios::app) << "# changed\n";
  expect_refused({"resume", path("a.kpart")}, {"small.pbrt", "a.kpart", "contents of its files differ"});
  expect_done({"resume", path("a.kpart"), "--scene", path("elsewhere/moved.pbrt"), "-q"});
}

TEST_F(PartialResults, BadOptionsAreExplained) {
  expect_refused({"render", scene_, "--pass-range", "0:4"}, {"--pass-range", "--passes"});
  for (const char* range : {"4", "4:4", "b:c", "0:4,3:5"})
    expect_refused(render({"--pass-range", range}), {"--pass-range", range, "0:16"});
  for (const char* time : {"60", "s", "-1s", "1 day", ""})
    expect_refused(render({"--checkpoint", path("a.kpart"), "--checkpoint-every", time}),
                   {"--checkpoint-every", "60s"});
  expect_refused(render({"--checkpoint-every", "60s"}), {"--checkpoint"});
  expect_refused(render({"--checkpoint", path("none/a.kpart")}), {"none"});
  expect_refused({"resume", path("none.kpart")}, {"none.kpart"});
  expect_refused({"resume", scene_}, {"not a partial result"});
}

// The hash covers the contents of all files that are included or named, not their paths.
TEST_F(PartialResults, HashCoversEveryFile) {
  const auto hash = [&](const std::string& folder, const std::string& part, const std::string& mesh) {
    std::filesystem::create_directories(path(folder));
    write(folder + "/s.pbrt", "WorldBegin\nInclude \"part.pbrt\"\n");
    write(folder + "/part.pbrt", part);
    write(folder + "/m.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
          "end_header\n" +
              mesh + "\n3 0 1 2\n");
    Diagnostics diagnostics;
    const auto loaded = pbrt::load_scene(path(folder + "/s.pbrt"), diagnostics);
    EXPECT_TRUE(loaded) << diagnostics.format_all();
    return loaded ? loaded->content_hash : "";
  };
  const std::string part = "Shape \"plymesh\" \"string filename\" \"m.ply\"\n", mesh = "0 0 0\n1 0 0\n0 1 0";
  const std::string first = hash("a", part, mesh);
  EXPECT_EQ(hash("b", part, mesh), first);
  EXPECT_NE(hash("c", part + "# note\n", mesh), first);
  EXPECT_NE(hash("d", part, "0 0 0\n1 0 0\n0 2 0"), first);
}

}  // namespace
}  // namespace kaustik::app
