// Tests kaustik sweep from the outside: files that agree, resumption, and refused input.

#include <gmock/gmock.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "apps/sweep/reference.h"
#include "core/files/file_lock.h"
#include "render/passes/partial_result.h"
#include "render/picture/image_io.h"
#include "tests/apps/support/child_process.h"
#include "tests/apps/support/program.h"
#include "tests/apps/support/watching.h"

namespace kaustik::app {
namespace {

using test::ChildProcess;
using test::Outcome;
using test::run_kaustik;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Arguments = std::vector<std::string>;
using Json = nlohmann::ordered_json;

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void sleep_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

class SweepCommand : public test::ProgramTest {
 protected:
  SweepCommand() {
    EXPECT_EQ(run_kaustik({"render", scene_, "--method", "mc", "--spp", "64", "--seed", "9", "-o",
                           path("ref.exr"), "-q"})
                  .code,
              kDone);
  }
  Arguments sweep(const Arguments& more, const std::string& folder = "out") const {
    return Arguments{"sweep", scene_,    "--photons", "1k,4k", "--radius",   "auto,2x", "--spp",
                     "2",     "--seeds", "2",         "-o",    path(folder), "-q"} +
           more;
  }
  Arguments against_file() const { return {"--reference", path("ref.exr")}; }
  void expect_done(const Arguments& arguments) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
  }
  void expect_refused(const Arguments& arguments, const std::string& part) const {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kBadCommandLine) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  }
  Json result(const std::string& folder = "out") const { return Json::parse(read(folder + "/sweep.json")); }
  // The contents of the finished cells' files by name.
  std::map<std::string, std::string> cells(const std::string& folder = "out") const {
    std::map<std::string, std::string> texts;
    if (!exists(folder + "/cells")) return texts;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder + "/cells"))) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".json") && !name.starts_with(".")) texts[name] = read(folder + "/cells/" + name);
    }
    return texts;
  }

  // The arguments of a sweep of one cell with a rendered reference.
  Arguments with_reference(const Arguments& more = {}) const {
    return Arguments{"sweep",   scene_, "--photons",        "1k",   "--radius", "auto",      "--spp", "2",
                     "--seeds", "1",    "--reference-time", "10ms", "-o",       path("out"), "-q"} +
           more;
  }

  std::string scene_ = small_scene(film(24, 16));
};

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST_F(SweepCommand, CsvAndJsonAgree) {
  expect_done(sweep(against_file() + Arguments{"--methods", "photon,mc"}));
  const Json cells = result()["cells"];
  const auto rows = csv_rows(read("out/sweep.csv"));
  ASSERT_EQ(cells.size(), 5u);  // mc has a single point
  ASSERT_EQ(rows.size(), 1 + cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    std::map<std::string, std::string> row;
    ASSERT_EQ(rows[i + 1].size(), rows[0].size());
    for (size_t k = 0; k < rows[0].size(); ++k) row[rows[0][k]] = rows[i + 1][k];
    EXPECT_EQ(row["method"], cells[i]["method"].get<std::string>());
    EXPECT_EQ(row["photons"], cells[i]["photons"].is_null() ? "" : cells[i]["photons"].dump());
    EXPECT_EQ(row["radius"], cells[i]["radius"].is_null() ? "" : cells[i]["radius"].get<std::string>());
    for (const char* key : {"relmse", "relative_rmse", "bias2", "variance"})
      EXPECT_EQ(row[key], cells[i]["error"][key].dump()) << key;
    for (const char* side : {"2", "4", "8"})
      EXPECT_EQ(row[std::string("relmse_") + side], cells[i]["error"]["relmse_of_blocks"][side].dump());
    EXPECT_EQ(row["seconds"], cells[i]["seconds"]["total"]["median"].dump());
    EXPECT_EQ(row["pareto"], cells[i]["pareto"].dump());
    // The parts of the error add up as error_parts.h says; sums of 1152 doubles.
    const double relmse = cells[i]["error"]["relmse"];
    EXPECT_NEAR(double(cells[i]["error"]["bias2"]) + double(cells[i]["error"]["variance"]), relmse, 1e-12);
  }
  const std::string page = read("out/report.html");
  EXPECT_THAT(page, HasSubstr("small.pbrt"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
}

// The errors match those of `render` followed by `compare`.
TEST_F(SweepCommand, ErrorsMatchTheRender) {
  expect_done(sweep(against_file()));
  const Json cell = result()["cells"][3];
  ASSERT_EQ(cell["flags"], "--photons 4k --radius 2x --spp 2");
  Json sum = {{"1", 0.0}, {"2", 0.0}, {"4", 0.0}, {"8", 0.0}};
  double flip = 0;
  for (const char* seed : {"0", "1"}) {
    expect_done({"render", scene_, "--photons", "4k", "--radius", "2x", "--spp", "2", "--seed", seed,
                 "--denoise", "off", "-o", path("a.exr"), "-q"});
    const Outcome compared = run_kaustik({"compare", path("ref.exr"), path("a.exr"), "--json", "--flip"});
    const Json json = Json::parse(compared.out);
    EXPECT_EQ(cell["error"]["relmse_by_seed"][size_t(seed[0] - '0')], json["relmse"]);
    flip += double(json["flip"]["mean"]) / 2;
    for (auto& [side, value] : sum.items()) value = double(value) + double(json["relmse_of_blocks"][side]);
  }
  EXPECT_DOUBLE_EQ(double(cell["error"]["flip"]), flip);
  for (const auto& [side, value] : sum.items()) {  // the mean of two rounds once in double
    EXPECT_NEAR(cell["error"]["relmse_of_blocks"][side], double(value) / 2, 1e-15) << side;
  }
}

// Multiples of two are exact in float.
TEST_F(SweepCommand, RadiusFactorsScaleEveryMap) {
  const auto radii = [&](const std::string& radius) {
    expect_done({"render", scene_, "--method", "photon", "--photons", "20k", "--radius", radius, "--spp", "1",
                 "-o", path("a.exr"), "--stats", path("s.json"), "-q"});
    return Json::parse(read("s.json"))["radii"];
  };
  const Json once = radii("auto"), half = radii("0.5x"), twice = radii("2x");
  for (const char* map : {"direct", "caustic", "indirect"}) {
    EXPECT_GT(once[map], 0) << map;
    EXPECT_EQ(double(half[map]), 0.5 * double(once[map])) << map;
    EXPECT_EQ(double(twice[map]), 2 * double(once[map])) << map;
  }
}

TEST_F(SweepCommand, FinishedSweepIsNotRenderedAgainAndMayGrow) {
  expect_done(sweep(against_file()));
  const auto before = cells();
  const std::string csv = read("out/sweep.csv"), json = read("out/sweep.json");
  expect_done(sweep(against_file()));
  EXPECT_EQ(cells(), before);
  EXPECT_EQ(read("out/sweep.csv"), csv);
  EXPECT_EQ(read("out/sweep.json"), json);
  expect_done(sweep(against_file() + Arguments{"--radius", "0.5x"}));  // adds one cell
  EXPECT_EQ(result()["cells"].size(), 6u);
  for (const auto& [name, text] : before) EXPECT_EQ(cells()[name], text);
}

// The sweep is killed when its first cell is written. That cell is kept, the others follow, and the errors
// are those of an uninterrupted sweep.
TEST_F(SweepCommand, ContinuesAfterAKillBetweenCells) {
  const Arguments more = against_file() + Arguments{"--photons", "30k,31k", "--threads", "1"};
  expect_done(sweep(more, "whole"));
  ChildProcess first(sweep(more));
  while (cells().empty() && first.running()) sleep_ms(1);
  first.kill(SIGKILL);
  first.wait();
  const auto kept = cells();
  ASSERT_FALSE(kept.empty());
  EXPECT_LT(kept.size(), 8u);
  EXPECT_FALSE(exists("out/report.html"));
  const std::string left = "out/.report.html.0123456789abcdef.partial",
                    left_cell = "out/cells/.a.json.0123456789abcdef.partial";
  for (const std::string& name : {left, left_cell}) write(name, "of a killed process");
  expect_done(sweep(more));
  EXPECT_FALSE(exists(left) || exists(left_cell));
  for (const auto& [name, text] : kept) EXPECT_EQ(cells()[name], text);
  const Json resumed = result()["cells"], whole = result("whole")["cells"];
  ASSERT_EQ(resumed.size(), whole.size());
  for (size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(resumed[i]["error"], whole[i]["error"]) << i;
}

TEST_F(SweepCommand, InterruptLeavesAFolderToContinueWith) {
  const std::string scene = small_scene(film(256, 256));
  std::atomic<bool> stop = false;
  std::thread sender([&] {
    test::wait_until_handled(SIGINT, stop);
    while (!stop && cells().empty()) sleep_ms(1);
    if (!stop) std::raise(SIGINT);
  });
  // The second point takes far longer than a test could wait for: only the signal can end it.
  const Outcome outcome =
      run_kaustik({"sweep", scene, "--photons", "1k", "--radius", "auto", "--spp", "1,1000000", "--seeds",
                   "1", "--reference-time", "100ms", "-o", path("out"), "-q"});
  stop = true;
  sender.join();
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_THAT(outcome.err, HasSubstr("1 of 2 points finished"));
  EXPECT_EQ(cells().size(), 1u);
  expect_done({"sweep", scene, "--photons", "1k", "--radius", "auto", "--spp", "1", "--seeds", "1",
               "--reference-time", "100ms", "-o", path("out"), "-q"});
}

// An interrupt keeps the complete passes of the reference, and the next run continues with them.
TEST_F(SweepCommand, InterruptedReferenceIsContinued) {
  const auto passes = [&] {
    return exists("out/reference.kpart")
               ? render::read_partial(path("out/reference.kpart")).sums.passes.count()
               : 0;
  };
  const auto run_until_more_than = [&](uint64_t before) {
    for (int ms = 500; passes() <= before && ms < 100'000; ms *= 2) {
      ChildProcess run(sweep({"--reference-time", "1h", "--threads", "1"}));
      while (!exists("out/sweep-of.json") && run.running()) sleep_ms(1);
      sleep_ms(ms);
      run.kill(SIGINT);
      EXPECT_THAT(run.wait(), AnyOf(kInterrupted, -1));  // -1 if a busy machine had not yet started the work
    }
    return passes();
  };
  const uint64_t first = run_until_more_than(0);
  EXPECT_GT(first, 0u);
  EXPECT_GT(run_until_more_than(first), first);
  EXPECT_THAT(cells(), IsEmpty());
}

TEST_F(SweepCommand, RenderedReferenceReportsItsNoise) {
  const Outcome outcome = run_kaustik(sweep({"--reference-time", "50ms", "--reference-method", "mc"}));
  ASSERT_EQ(outcome.code, kDone) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("never finds the light of point lights through glass"));
  const Json reference = result()["reference"];
  EXPECT_THAT(reference["source"].get<std::string>(), HasSubstr("method mc"));
  EXPECT_GE(reference["passes"], 2);
  EXPECT_GT(reference["noise_relmse"], 0);
  EXPECT_FALSE(exists("out/reference.kpart"));
  const std::string exr = read("out/reference.exr");
  expect_done(sweep({"--reference-time", "50ms", "--reference-method", "mc", "--radius", "3x"}));
  EXPECT_TRUE(read("out/reference.exr") == exr);  // used as it is
}

TEST_F(SweepCommand, RefusesTheFolderOfAnotherSweep) {
  expect_done(sweep(against_file()));
  expect_refused(sweep(against_file() + Arguments{"--max-bounces", "3"}),
                 "holds the results of another sweep");
  expect_refused(sweep(against_file() + Arguments{"--max-bounces", "3"}),
                 "settings max-bounces: in the folder \"16\", now \"3\"");
  expect_refused(sweep({"--reference-time", "1s"}), "reference");
  small_scene(film(24, 16) + "\n# another");
  expect_refused(sweep(against_file()), "scene: in the folder");
  // Writing the difference called a function for each level, and took the whole stack.
  const size_t levels = 200'000;
  std::string deep = read("out/sweep-of.json");
  deep.insert(1, "\"scene\":" + std::string(levels, '[') + std::string(levels, ']') + ",");
  write("out/sweep-of.json", deep);
  expect_refused(sweep(against_file()), "is damaged");
}

TEST_F(SweepCommand, BadInputExitsWithTwo) {
  expect_refused(sweep(against_file() + Arguments{"--methods", "photonn"}), "did you mean `photon`?");
  expect_refused(sweep(against_file() + Arguments{"--photons", "0"}), "--photons: `0`");
  expect_refused(sweep(against_file() + Arguments{"--photons", "1k"}), "given twice");
  expect_refused(sweep(against_file() + Arguments{"--radius", "wide"}), "--radius: `wide`");
  expect_refused(sweep(against_file() + Arguments{"--reference-time", "1m"}), "--reference");
  expect_refused(sweep({"--reference-time", "0s"}), "--reference-time");
  expect_refused(sweep({"--reference-method", "best"}), "--reference-method");
  expect_refused(sweep(against_file() + Arguments{"--width", "12"}),
                 "it has 24 x 16 pixels, but the scene's picture has 12 x 8");
  expect_refused(sweep({"--reference", path("none.exr")}), "none.exr");
  expect_refused(sweep({"--reference", scene_}, "bad"), "--reference");
  write("file", "");
  expect_refused(sweep(against_file(), "file"), "it is not a folder");
  expect_refused({"sweep", scene_}, "--output is required");
  EXPECT_EQ(run_kaustik({"sweep", path("no.pbrt"), "-o", path("x")}).code, kBadScene);
}

TEST_F(SweepCommand, DamagedCellIsRenderedAgain) {
  expect_done(sweep(against_file()));
  const Json before = result()["cells"];
  const std::string name = "out/cells/" + cells().begin()->first;
  write(name, "{\"error\": ");
  const Outcome outcome = run_kaustik(sweep(against_file()));
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_THAT(outcome.err, HasSubstr("the cell is rendered again"));
  const Json after = result()["cells"];
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(after[i]["error"], before[i]["error"]);
}

// A folder may come from anybody; its report must not hold files from elsewhere.
TEST_F(SweepCommand, CellsThatNameOtherFilesAreRenderedAgain) {
  expect_done(sweep(against_file()));
  write("secret.txt", "nobody may see this");  // begins with bm9ib2R5 in base 64
  const auto expect_again = [&](const std::string& what) {
    const Outcome outcome = run_kaustik(sweep(against_file()));
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_THAT(outcome.err, HasSubstr("the cell is rendered again"));
    EXPECT_THAT(read("out/report.html"), Not(HasSubstr("bm9ib2R5")));
  };
  const std::string name = cells().begin()->first, key = name.substr(0, name.find('.'));
  for (const char* field : {"picture", "error_map"}) {
    Json cell = Json::parse(read("out/cells/" + name));
    cell[field] = "../secret.txt";
    write("out/cells/" + name, cell.dump());
    expect_again("its " + std::string(field) + " is not");
  }
  std::filesystem::remove(path("out/cells/" + key + ".png"));
  std::filesystem::create_symlink(path("secret.txt"), path("out/cells/" + key + ".png"));
  expect_again("not a regular file");
}

TEST_F(SweepCommand, DamagedReferenceIsRenderedAgain) {
  expect_done(with_reference());
  const std::string about = read("out/reference.json"), picture = read("out/reference.exr");
  const auto expect_again = [&](const std::string& what) {
    const Outcome outcome = run_kaustik(with_reference());
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_THAT(outcome.err, HasSubstr("the reference is rendered"));
    EXPECT_THAT(run_kaustik(with_reference()).err, Not(HasSubstr("the reference is rendered")));
  };
  for (const char* text : {"{\"source\":1}", "[]", "{"}) {
    write("out/reference.json", text);
    expect_again("reference.json");
  }
  write("out/reference.exr", "garbage");
  expect_again("reference.exr");
  write("out/reference.exr", picture);
  write("out/reference.json",
        about.substr(0, about.find("hash") + 8) + "x" + about.substr(about.find("hash") + 8));
  expect_again("not the picture");
  std::filesystem::remove(path("out/reference.exr"));
  write("out/reference.kpart", "garbage");
  expect_again("reference.kpart");
}

// A cell is valid only for the reference it was compared with.
TEST_F(SweepCommand, AnotherReferenceInvalidatesCells) {
  expect_done(with_reference());
  const auto before = cells();
  expect_done(with_reference());
  EXPECT_EQ(cells(), before);  // the file contains exactly the rendered picture
  // Replaces the reference by one with another number of passes.
  std::filesystem::copy_file(path("ref.exr"), path("out/reference.exr"),
                             std::filesystem::copy_options::overwrite_existing);
  Json about = Json::parse(read("out/reference.json"));
  about["hash"] = picture_hash(render::read_image(path("ref.exr")));
  write("out/reference.json", about.dump());
  expect_done(with_reference());
  EXPECT_EQ(cells().size(), before.size() + 1);
}

// The settings that a sweep varies do not affect the reference: two references with as many passes are the
// same picture. (Two passes of 10^6 photons take longer than 10 ms, so there are two.)
TEST_F(SweepCommand, SweptSettingsDoNotAffectTheReference) {
  const Arguments other = {"--lookup",   "leaf",          "--kernel",  "cone",
                           "--emission", "uniform-angle", "--nearest", "3"};
  const auto mean_after = [&](const Arguments& more) {
    expect_done(with_reference(more));
    const Json reference = result()["reference"];
    std::filesystem::remove_all(path("out"));
    return std::pair(uint64_t(reference["passes"]), double(reference["mean"]));
  };
  const auto plain = mean_after({}), examined = mean_after(other);
  ASSERT_EQ(plain.first, 2u);
  ASSERT_EQ(examined.first, 2u);
  EXPECT_EQ(plain.second, examined.second);
}

TEST_F(SweepCommand, FolderTakesOneSweepAtATime) {
  expect_done(sweep(against_file()));
  {
    const FileLock other(path("out/.lock"));
    expect_refused(sweep(against_file()), "another sweep is running");
  }
  expect_done(sweep(against_file()));
}

// Stop rules do not apply to the renders of a sweep.
TEST_F(SweepCommand, StopRulesOfTheSceneAreIgnored) {
  small_scene(film(24, 16) +
              "\nIntegrator \"photonmap\" \"string target-error\" \"10%\" \"string time\" \"2s\"");
  expect_done(sweep(against_file()));
  for (const char* name : {"target-error", "target-quantile", "time"})
    EXPECT_FALSE(result()["settings"].contains(name)) << name;
}

TEST_F(SweepCommand, IntegerReferenceGivesAWarning) {
  EXPECT_EQ(run_kaustik({"render", scene_, "--spp", "1", "-o", path("ref.png"), "-q"}).code, kDone);
  const std::string warning = "in an integer format";
  EXPECT_THAT(run_kaustik(sweep({"--reference", path("ref.png")}, "png")).err, HasSubstr(warning));
  EXPECT_THAT(run_kaustik(sweep(against_file())).err, Not(HasSubstr(warning)));
}

// All pictures of a sweep have the reference's exposure, so that they can be compared by eye.
TEST_F(SweepCommand, PicturesShareOneExposure) {
  const auto picture_of_cell = [&](const std::string& folder) {
    return read(folder + "/" + result(folder)["cells"][0]["picture"].get<std::string>());
  };
  const Arguments one = {"sweep", scene_,    "--photons", "1k",          "--spp",
                         "2",     "--seeds", "1",         "--reference", path("ref.exr")};
  const Outcome automatic = run_kaustik(one + Arguments{"-o", path("auto")});
  EXPECT_EQ(automatic.code, kDone) << automatic.err;
  const std::string stops = test::logged_exposure(automatic.err);
  ASSERT_NE(stops, "none is logged") << automatic.err;
  expect_done(one + Arguments{"-o", path("named"), "--exposure", stops, "-q"});
  EXPECT_EQ(picture_of_cell("auto"), picture_of_cell("named"));
  EXPECT_EQ(read("auto/reference.png"), read("named/reference.png"));
  EXPECT_NEAR(result("auto")["reference"]["exposure"].get<double>(), std::stod(stops), 1e-5);
  EXPECT_EQ(result("auto")["reference"]["tonemap"], "filmic");
  expect_done(one + Arguments{"-o", path("three"), "--exposure", "3", "-q"});
  EXPECT_NE(picture_of_cell("auto"), picture_of_cell("three"));
}

// A far light covers much of the picture but gives little light: metered, it would darken the rest by stops.
TEST_F(SweepCommand, ExposureLeavesOutLightsThatTheReferenceShows) {
  const std::string scene = write(
      "lit.pbrt", read("small.pbrt") +
                      "Translate 0 0 -40\nMaterial \"diffuse\"\n"
                      "AreaLightSource \"diffuse\" \"rgb L\" 1000\nShape \"sphere\" \"float radius\" 12\n");
  const auto exposure_by = [&](const Arguments& arguments) {
    const Outcome outcome = run_kaustik(arguments);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return test::logged_exposure(outcome.err);
  };
  const Arguments render = {"render", scene, "--method", "mc", "--spp", "16", "--denoise", "off"};
  const std::string rendered = exposure_by(
      render + Arguments{"-o", path("lit.exr"), "-o", path("lit.png"), "--aov", "emitted,denoising_emitted"});
  exposure_by(render + Arguments{"-o", path("plain.exr")});
  const auto exposure_of_sweep = [&](const std::string& folder, const Arguments& reference) {
    return exposure_by(
        Arguments{"sweep", scene, "--photons", "1k", "--spp", "2", "--seeds", "1", "-o", path(folder)} +
        reference);
  };
  EXPECT_EQ(exposure_of_sweep("layers", {"--reference", path("lit.exr")}), rendered);
  EXPECT_LT(std::stod(exposure_of_sweep("plain", {"--reference", path("plain.exr")})),
            std::stod(rendered) - 1);
  const Arguments own = {"--reference-time", "50ms", "--reference-method", "mc"};
  const std::string first = exposure_of_sweep("own", own);
  EXPECT_NEAR(std::stod(first), std::stod(rendered), 0.5);  // another seed, and other samples
  EXPECT_EQ(exposure_of_sweep("own", own), first) << "the reference that was kept";
}

TEST_F(SweepCommand, BadGridIsReportedBeforeAnythingIsRendered) {
  expect_refused(with_reference({"--photons", "100", "--passes", "1000"}),
                 "cannot be divided among 1k passes");
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace kaustik::app
