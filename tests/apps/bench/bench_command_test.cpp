// Tests kaustik bench from the outside: points, exact counts, files, bad command lines. Times are only
// compared with other times of the same file.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/bench/bench_result.h"
#include "render/picture/image_formats.h"
#include "tests/apps/support/program.h"
#include "tests/apps/support/watching.h"

namespace kaustik::app {
namespace {

using test::count_threads;
using test::Outcome;
using test::run_kaustik;
using test::ThreadCounts;
using test::wait_until_handled;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BenchCommand : public test::ProgramTest {
 protected:
  std::string tiny_scene() const { return small_scene(film(16, 12)); }
  Json result(const std::string& name) const { return Json::parse(read(name)); }

  Json measured(std::vector<std::string> options) const {
    std::vector<std::string> arguments = {"bench",  tiny_scene(),   "--spp", "1",
                                          "--json", path("r.json"), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return result("r.json");
  }
};

// Expects that every number below `value` is a whole number.
void expect_whole_numbers(const Json& value, const std::string& name) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) expect_whole_numbers(inner, name + "." + key);
  } else {
    EXPECT_TRUE(value.is_number_unsigned()) << name;
  }
}

TEST_F(BenchCommand, MeasuresEveryPointInTheOrderOfTheCommandLine) {
  const Json r = measured({"--photons", "2k,1k", "--threads", "2,1,3", "--repeat", "2"});
  std::vector<std::pair<int, int>> points;
  for (const Json& p : r["points"]) points.emplace_back(p["photons"], p["threads"]);
  using Pair = std::pair<int, int>;
  EXPECT_THAT(points, ElementsAre(Pair(2000, 2), Pair(2000, 1), Pair(2000, 3), Pair(1000, 2), Pair(1000, 1),
                                  Pair(1000, 3)));
  EXPECT_EQ(r["repeat"], 2);
  EXPECT_EQ(r["settings"]["spp"], 1);
  EXPECT_EQ(r["settings"]["width"], 16);
  EXPECT_FALSE(r["settings"].contains("photons"));
}

// Counters are equal for any number of threads, for repeats and for separate runs of the program. Some of the
// rays per kind are known beforehand.
TEST_F(BenchCommand, CountersAreWholeNumbersThatDoNotDependOnThreads) {
  for (const char* method : {"auto", "hybrid", "photon", "mc"}) {
    const Json r =
        measured({"--photons", "20k", "--threads", "1,2,3,8", "--repeat", "2", "--method", method});
    const Json& counters = r["points"][0]["counters"];
    expect_whole_numbers(counters, "counters");
    for (const Json& p : r["points"]) EXPECT_EQ(p["counters"], counters) << method << " " << p["threads"];
    const Json again = measured({"--photons", "20k", "--threads", "2", "--repeat", "1", "--method", method});
    EXPECT_EQ(again["points"][0]["counters"], counters) << method;
    // Only methods that trace paths from the camera take no adaptive samples.
    EXPECT_GE(counters["rays"]["camera"], 16 * 12);
    if (method == std::string("mc") || method == std::string("hybrid")) {
      EXPECT_EQ(counters["rays"]["camera"], 16 * 12);
    }
    EXPECT_LE(counters["gather"]["accepted"], counters["gather"]["candidates"]);
    // Guided kinds have photons of their own; where all kinds are guided there are no others.
    const uint64_t emitted = counters["photons"]["emitted"],
                   guided = counters["photons"]["guided"]["emitted"];
    if (method == std::string("mc"))
      EXPECT_EQ(emitted + guided, 0u);
    else
      EXPECT_TRUE(emitted == 20000 || (emitted == 0 && guided >= 20000)) << method << " " << emitted;
    EXPECT_EQ(counters["photons"]["octree_nodes"] > 0, method != std::string("mc"));
  }
}

TEST_F(BenchCommand, CountersMatchTheRender) {
  const Json bench =
      measured({"--photons", "5k", "--threads", "1", "--repeat", "1"})["points"][0]["counters"];
  ASSERT_EQ(run_kaustik({"render", tiny_scene(), "--spp", "1", "--photons", "5k", "-o", path("a.exr"),
                         "--stats", path("s.json"), "-q"})
                .code,
            kDone);
  const Json stats = result("s.json");
  for (const auto& [key, value] : bench.items()) EXPECT_EQ(value, stats[key]) << key;
}

TEST_F(BenchCommand, SpeedUpAndEfficiencyFollowFromTheMedians) {
  const Json r = measured({"--photons", "20k", "--threads", "2,1", "--repeat", "3"});
  const Json &base = r["points"][0], &other = r["points"][1];
  EXPECT_EQ(base["speed_up"]["total"], 1.0);
  EXPECT_EQ(base["efficiency"]["total"], 1.0);
  for (const char* phase : {"photon_trace", "photon_build", "render", "total"}) {
    const double gain =
        base["seconds"][phase]["median"].get<double>() / other["seconds"][phase]["median"].get<double>();
    // Both sides divide the same doubles; writing and reading them back is exact.
    EXPECT_DOUBLE_EQ(other["speed_up"][phase].get<double>(), gain) << phase;
    EXPECT_DOUBLE_EQ(other["efficiency"][phase].get<double>(), 2 * gain) << phase;  // half as many threads
  }
  for (const Json& p : r["points"]) {
    EXPECT_LE(p["seconds"]["total"]["min"], p["seconds"]["total"]["median"]);
    EXPECT_LE(p["seconds"]["total"]["median"], p["seconds"]["total"]["max"]);
    EXPECT_GT(p["per_second"]["photons"]["min"], 0);
    EXPECT_GT(p["per_second"]["gather_queries"]["min"], 0);
    EXPECT_GT(p["busy_cores"]["min"], 0);
    EXPECT_GT(p["peak_memory_bytes"]["min"], 0);
  }
}

TEST_F(BenchCommand, NamesTheMachineAndTheLibraries) {
  const Json r = measured({"--photons", "1k", "--threads", "1", "--repeat", "1"});
  const Json& machine = r["machine"];
  for (const char* key : {"cpu", "architecture", "isa", "caches", "cores", "libraries"})
    EXPECT_TRUE(machine.contains(key)) << key;
  for (const char* library : {"embree", "tbb", "openimageio", "highway"})
    EXPECT_THAT(machine["libraries"][library].get<std::string>(),
                ::testing::MatchesRegex("[0-9]+\\.[0-9.]+"));
  EXPECT_GE(machine["cores"]["usable"], 1);
  EXPECT_LE(machine["cores"]["usable"], machine["cores"]["hardware"]);
}

TEST_F(BenchCommand, ThreadsBoundsEveryThreadOfTheProcess) {
  const std::string scene = small_scene(film(48, 48));
  render::image_formats();  // brings libraries with idle threads of their own
  int code = -1;
  const ThreadCounts threads = count_threads([&] {
    code = run_kaustik({"bench", scene, "--photons", "50k", "--spp", "2", "--threads", "1,2", "--repeat", "2",
                        "--json", path("r.json"), "--plot", path("plots"), "-q"})
               .code;
  });
  EXPECT_EQ(code, kDone);
  EXPECT_LE(threads.most, threads.before + 1);
}

TEST_F(BenchCommand, PlotsAreTheSameWhenMeasuringAndFromTheFile) {
  const Outcome measured =
      run_kaustik({"bench", tiny_scene(), "--spp", "1", "--photons", "1k,4k", "--threads", "1,2", "--repeat",
                   "2", "--json", path("r.json"), "--plot", path("first/")});
  ASSERT_EQ(measured.code, kDone) << measured.err;
  EXPECT_THAT(measured.err, HasSubstr("wrote " + path("r.json")));
  const Outcome drawn = run_kaustik({"bench", "--from", path("r.json"), "--plot", path("second")});
  ASSERT_EQ(drawn.code, kDone) << drawn.err;
  EXPECT_EQ(drawn.out, measured.out);
  EXPECT_EQ(read("first/scaling.html"), read("second/scaling.html"));
  EXPECT_TRUE(read("first/scaling.html").starts_with("<!DOCTYPE html>"));
}

TEST_F(BenchCommand, BadCommandLinesExitWithTwoBeforeAnythingIsMeasured) {
  const std::string scene = path("missing.pbrt");  // never opened
  write("not-a-folder", "");
  write("text.json", "{\"kaustik_bench\": 1, \"version\"");
  write("render.json", "{\"version\": \"0.1.0\"}");
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{}, "give a scene"},
      {{scene, "--from", path("render.json")}, "give a scene"},
      {{scene, "--photons", "0"}, "--photons: `0`"},
      {{scene, "--photons", "1M,many"}, "--photons: `many`"},
      {{scene, "--photons", "1M,1000k"}, "`1000k` is given twice"},
      {{scene, "--threads", "1,x"}, "--threads: `x`"},
      {{scene, "--threads", "-1"}, "--threads"},
      {{scene, "--threads", "65536"}, "1 to 65535"},
      {{scene, "--repeat", "0"}, "--repeat: `0`"},
      {{scene, "--repeat", "1.5"}, "--repeat: `1.5`"},
      {{scene, "--spp", "0"}, "--spp"},
      {{scene, "--aov", "all"}, "unknown option --aov"},
      {{scene, "--json", path("no/r.json")}, "there is no folder"},
      {{scene, "--plot", path("no/plots")}, "there is no folder"},
      {{scene, "--plot", path("not-a-folder")}, "not a folder"},
      {{"--from", path("missing.json")}, "missing.json: No such file"},
      {{"--from", path("text.json")}, "not a result of kaustik bench"},
      {{"--from", path("render.json")}, "\"kaustik_bench\" is missing"},
      {{"--from", path("render.json"), "--repeat", "2"}, "excludes"},
      {{"--from", path("render.json"), "--spp", "2"}, "excludes"}};
  for (const auto& [options, complaint] : bad) {
    std::vector<std::string> arguments = {"bench"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine) << complaint;
    EXPECT_THAT(outcome.err, HasSubstr(complaint));
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_THAT(files(), ElementsAre("not-a-folder", "render.json", "text.json"));
}

TEST_F(BenchCommand, BadScenesExitWithThree) {
  const Outcome outcome = run_kaustik({"bench", path("missing.pbrt"), "--json", path("r.json")});
  EXPECT_EQ(outcome.code, kBadScene);
  EXPECT_THAT(outcome.err, HasSubstr("missing.pbrt"));
  EXPECT_FALSE(exists("r.json"));
}

// Rates are compared, so that twice the photons in the same time are a speed-up of two.
TEST_F(BenchCommand, PhotonsMayGrowWithTheThreads) {
  const Json r = measured({"--photons", "1k", "--photons-per-thread", "2k", "--threads", "1,2", "--repeat",
                           "1", "--method", "photon"});
  ASSERT_EQ(r["points"].size(), 4u);
  const Json &one = r["points"][2], &two = r["points"][3];
  EXPECT_EQ(one["photons"], 2000);
  EXPECT_EQ(two["photons"], 4000);
  EXPECT_EQ(two["photons_per_thread"], 2000);
  EXPECT_EQ(two["counters"]["photons"]["emitted"], 4000);
  const auto trace = [](const Json& p) { return p["seconds"]["photon_trace"]["median"].get<double>(); };
  EXPECT_DOUBLE_EQ(two["speed_up"]["photon_trace"].get<double>(), 2 * trace(one) / trace(two));
  const Outcome shown = run_kaustik({"bench", "--from", path("r.json")});
  EXPECT_THAT(shown.out, HasSubstr("2k photons per thread\n"));
}

TEST_F(BenchCommand, WorkAndSpanAreThoseOfAllPhases) {
  const Json r = measured({"--photons", "1k,2k", "--threads", "1", "--repeat", "1", "--span"});
  ASSERT_EQ(r["spans"].size(), 2u);
  for (const Json& span : r["spans"])
    for (const char* phase : {"load", "bvh", "photon_trace", "photon_build", "render"}) {
      const Json& of = span["phases"][phase];
      EXPECT_GT(of["seconds"], 0) << phase;
      EXPECT_LE(of["span"], of["seconds"]) << phase;
      EXPECT_LE(of["serial"], of["span"]) << phase;
      EXPECT_FALSE(of["places"].empty()) << phase;
    }
  EXPECT_EQ(r["spans"][1]["photons"], 2000);
}

// Twice as slow in all runs, or as fast: the earlier result is made from the later one.
TEST_F(BenchCommand, TellsASlowDownFromTheBaseline) {
  const Json now = measured({"--photons", "1k", "--threads", "1", "--repeat", "3"});
  const auto run = [&](double factor, std::vector<std::string> more) {
    Json before = now;
    for (auto& [phase, seconds] : before["points"][0]["seconds"].items())
      for (auto& [name, value] : seconds.items()) value = value.get<double>() * factor;
    std::vector<std::string> arguments = {"bench", "--from", path("r.json"), "--baseline",
                                          write("before.json", before.dump())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_kaustik(arguments);
  };
  const Outcome same = run(1, {"--max-slowdown", "10"});
  EXPECT_EQ(same.code, kDone) << same.err;
  EXPECT_THAT(same.out, HasSubstr("time over that of the baseline"));
  EXPECT_THAT(same.out, HasSubstr("1.00 ("));
  const Outcome slower = run(1e-3, {"--max-slowdown", "10"});
  EXPECT_EQ(slower.code, kFailed);
  EXPECT_THAT(slower.err, HasSubstr("1k photons, 1 thread: 1e+03 times as long as before"));
  EXPECT_EQ(run(1e-3, {}).code, kDone) << "nobody set a limit";
  EXPECT_EQ(run(1e3, {"--max-slowdown", "10"}).code, kDone) << "faster";
  EXPECT_EQ(run_kaustik({"bench", "--from", path("r.json"), "--max-slowdown", "10"}).code, kBadCommandLine);
  // Other work is not compared.
  Json other = now;
  other["settings"]["spp"] = 99;
  const Outcome refused =
      run_kaustik({"bench", "--from", path("r.json"), "--baseline", write("o.json", other.dump())});
  EXPECT_EQ(refused.code, kBadCommandLine);
  EXPECT_THAT(refused.err, HasSubstr("spp is 1, it was 99"));
  other = now;
  other["points"][0]["threads"] = 7;
  EXPECT_EQ(
      run_kaustik({"bench", "--from", path("r.json"), "--baseline", write("o.json", other.dump())}).code,
      kBadCommandLine);
}

TEST_F(BenchCommand, SaysThatOtherProgramsRan) {
  Json now = measured({"--photons", "1k", "--threads", "1", "--repeat", "1"});
  const auto run = [&](const Json& waiting) {
    now["points"][0]["waiting"] = waiting;
    return run_kaustik({"bench", "--from", write("w.json", now.dump()), "--require-idle"});
  };
  const Outcome idle = run({{"median", 0.01}, {"min", 0}, {"max", 0.9}});
  EXPECT_EQ(idle.code, kDone);
  EXPECT_THAT(idle.out, ::testing::Not(HasSubstr("Other programs ran")));
  const Outcome busy = run({{"median", 0.2}, {"min", 0.1}, {"max", 0.9}});
  EXPECT_EQ(busy.code, kFailed);
  EXPECT_THAT(busy.out, HasSubstr("Other programs ran"));
  EXPECT_THAT(busy.err, HasSubstr("threads waited for cores"));
  EXPECT_THAT(run(nullptr).out, HasSubstr("not available"));
}

TEST_F(BenchCommand, WritesTheFormOfGoogleBenchmark) {
  measured({"--photons", "1k", "--threads", "1,2", "--repeat", "1"});
  ASSERT_EQ(
      run_kaustik({"bench", "--from", path("r.json"), "--json", path("g.json"), "--format", "gbench"}).code,
      kDone);
  const Json g = result("g.json"), r = result("r.json");
  ASSERT_EQ(g["benchmarks"].size(), 2 * r["points"][0]["seconds"].size());
  const Json& last = g["benchmarks"].back();
  EXPECT_EQ(last["run_name"], "small.pbrt/photons:1000/threads:2/total");
  EXPECT_EQ(last["real_time"], 1e3 * r["points"][1]["seconds"]["total"]["median"].get<double>());
  EXPECT_TRUE(g["context"]["num_cpus"].is_number());
  EXPECT_EQ(
      run_kaustik({"bench", "--from", path("r.json"), "--json", path("g.json"), "--format", "xml"}).code,
      kBadCommandLine);
}

// An error in a file that was edited by hand names the field.
TEST_F(BenchCommand, DamagedResultsAreRefusedNamingTheField) {
  const Json good = measured({"--photons", "1k", "--threads", "1", "--repeat", "1", "--span"});
  const auto refused = [&](const char* pointer, const Json& value) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    const Outcome outcome = run_kaustik({"bench", "--from", write("bad.json", bad.dump())});
    EXPECT_EQ(outcome.code, kBadCommandLine) << pointer;
    return outcome.err;
  };
  EXPECT_THAT(refused("/kaustik_bench", 2), HasSubstr("\"kaustik_bench\": expected"));
  EXPECT_THAT(refused("/points", Json::array()), HasSubstr("\"points\": expected"));
  EXPECT_THAT(refused("/points/0/threads", 0), HasSubstr("\"threads\": expected"));
  EXPECT_THAT(refused("/points/0/threads", 1e300), HasSubstr("\"threads\": expected"));
  EXPECT_THAT(refused("/points/0/photons", "1k"), HasSubstr("\"photons\": expected"));
  EXPECT_THAT(refused("/points/0/seconds/total/min", nullptr), HasSubstr("\"min\": expected"));
  EXPECT_THAT(refused("/points/0/seconds/total/max", -1), HasSubstr("\"max\": expected"));
  EXPECT_THAT(refused("/points/0/counters", 5), HasSubstr("\"counters\": expected"));
  EXPECT_THAT(refused("/spans/0/phases/render/seconds", "long"), HasSubstr("\"seconds\": expected"));
  EXPECT_THAT(refused("/machine", "mine"), HasSubstr("\"machine\": expected"));
}

// Functions that copy values call themselves for each level, and such a file took the whole stack.
TEST_F(BenchCommand, DeepResultsAreRefused) {
  std::string text = measured({"--photons", "1k", "--threads", "1", "--repeat", "1"}).dump();
  const std::string before = "\"counters\":{";
  ASSERT_NE(text.find(before), text.npos);
  const size_t levels = 200'000;
  text.insert(text.find(before) + before.size(),
              "\"deep\":" + std::string(levels, '[') + std::string(levels, ']') + ",");
  const Outcome outcome = run_kaustik({"bench", "--from", write("deep.json", text)});
  EXPECT_EQ(outcome.code, kBadCommandLine);
  EXPECT_THAT(outcome.err, HasSubstr("nested deeper than 64 levels"));
}

TEST_F(BenchCommand, AnInterruptWritesNothingAndExitsWith130) {
  const std::string scene = small_scene(film(256, 256));
  std::atomic<bool> stop = false;
  std::thread sender([&] {
    wait_until_handled(SIGINT, stop);
    if (!stop) std::raise(SIGINT);
  });
  // These are far more runs and samples than a test could wait for: only the signal can end them.
  const Outcome outcome = run_kaustik({"bench", scene, "--photons", "1k", "--spp", "1000000", "--json",
                                       path("r.json"), "--plot", path("plots"), "-q"});
  stop = true;
  sender.join();
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_THAT(files(), ElementsAre("small.pbrt"));
}

TEST_F(BenchCommand, SceneNamesThatAreNotUtf8AreReplaced) {
  const std::string scene = path("caf\xe9.pbrt");
  std::filesystem::rename(tiny_scene(), scene);
  const Outcome outcome = run_kaustik({"bench", scene, "--spp", "1", "--photons", "1k", "--threads", "1",
                                       "--repeat", "1", "--json", path("r.json"), "-q"});
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_THAT(result("r.json")["scene"].get<std::string>(), HasSubstr("caf\xef\xbf\xbd.pbrt"));
}

TEST(BenchResult, SpreadIsMedianLeastAndLargest) {
  const Spread odd = spread_of({5, 1, 3});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.max, 5);
  EXPECT_EQ(spread_of({4, 1, 2, 8}).median, 3);
  EXPECT_EQ(spread_of({7}).median, 7);
}

// Four threads that take a third of the time of two threads are 3 times as fast, at twice the threads: an
// efficiency of 3 / 2.
TEST(BenchResult, SpeedUpIsRelativeToTheFirstPointWithEqualPhotons) {
  BenchResult r;
  r.points.resize(3);
  const auto set = [&](size_t i, uint64_t photons, int threads, Spread total) {
    r.points[i].photons = photons;
    r.points[i].threads = threads;
    r.points[i].seconds[static_cast<size_t>(Phase::kTotal)] = total;
  };
  set(0, 10, 1, {99, 99, 99});
  set(1, 20, 2, {6, 5, 7});
  set(2, 20, 4, {2, 1, 4});
  const Spread gain = speed_up(r, r.points[2], Phase::kTotal).value();
  EXPECT_EQ(gain.median, 3);
  EXPECT_EQ(gain.min, 1.5);
  EXPECT_EQ(gain.max, 6);
  EXPECT_EQ(efficiency(r, r.points[2], Phase::kTotal), 1.5);
  EXPECT_EQ(speed_up(r, r.points[2], Phase::kBvh), std::nullopt);  // the phase took no time
}

// t = 8 (s + (1 - s) / n) with s = 1/4: 8, 5 and 3.5 s on 1, 2 and 4 threads.
TEST(BenchResult, SerialShareIsFittedToTheCurve) {
  BenchResult r;
  const auto add = [&](uint64_t photons, int threads, double seconds) {
    BenchPoint point;
    point.photons = photons, point.threads = threads;
    point.seconds[static_cast<size_t>(Phase::kTotal)] = {seconds, seconds, seconds};
    r.points.push_back(point);
  };
  add(10, 1, 8), add(10, 2, 5), add(10, 4, 3.5), add(20, 1, 1);
  EXPECT_NEAR(fitted_serial_share(r, r.points[0], Phase::kTotal).value(), 0.25, 1e-12);
  EXPECT_FALSE(fitted_serial_share(r, r.points[3], Phase::kTotal)) << "one number of threads";
}

}  // namespace
}  // namespace kaustik::app
