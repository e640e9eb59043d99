// Files that are no regular ones, and names that are hard to write: found before anything is rendered.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>

#include "apps/console/exit_code.h"
#include "core/files/file_lock.h"
#include "tests/apps/support/program.h"

namespace kaustik::test {
namespace {

using app::kBadCommandLine;
using app::kBadScene;
using app::kDone;
using ::testing::HasSubstr;

class UnusualFiles : public ProgramTest {
 protected:
  std::string pipe(const std::string& name) const {
    EXPECT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
    return path(name);
  }
  Outcome render(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"render", scene, "--spp", "1", "--photons", "100", "-q"};
    if (more.empty()) arguments.insert(arguments.end(), {"-o", path("a.exr")});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_kaustik(arguments);
  }
  void expect_refused(const Outcome& outcome, int code, const std::string& message) const {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_FALSE(exists("a.exr"));
  }
};

constexpr const char* kNotRegular = "not a regular file";

// To open a pipe would wait for a writer for ever.
TEST_F(UnusualFiles, PipesAreNoScenes) {
  for (const std::string ending : {"pbrt", "gltf", "glb", "obj", "ply", "stl"}) {
    const std::string file = pipe("pipe." + ending);
    expect_refused(render(file), kBadScene, kNotRegular);
    expect_refused(run_kaustik({"info", file}), kBadScene, kNotRegular);
  }
  expect_refused(render("/dev/zero"), kBadScene, kNotRegular);
}

TEST_F(UnusualFiles, ScenesDoNotReadPipes) {
  for (const std::string ending : {"pbrt", "ply", "png"}) pipe("pipe." + ending);
  for (const std::string line :
       {"Include \"pipe.pbrt\"", "Shape \"plymesh\" \"string filename\" \"pipe.ply\"",
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"pipe.png\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"t\""}) {
    const std::string scene = write("a.pbrt", "WorldBegin\n" + line + "\nShape \"sphere\"\n");
    expect_refused(render(scene), kBadScene, kNotRegular);
  }
  // Of an OBJ's libraries, only those that are regular files are found.
  write("a.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  pipe("pipe.mtl");
  EXPECT_THAT(run_kaustik({"info", path("a.obj")}).err, HasSubstr("pipe.mtl"));
}

TEST_F(UnusualFiles, PipesAreNoOtherInputs) {
  const std::string file = pipe("pipe"), scene = small_scene(film(8, 8));
  expect_refused(run_kaustik({"compare", file, file}), kBadCommandLine, kNotRegular);
  expect_refused(run_kaustik({"denoise", file, "-o", path("a.exr")}), kBadCommandLine, kNotRegular);
  expect_refused(run_kaustik({"merge", file, "-o", path("a.exr")}), kBadCommandLine, kNotRegular);
  expect_refused(run_kaustik({"resume", file, "-o", path("a.exr")}), kBadCommandLine, "regular file");
  expect_refused(run_kaustik({"bench", "--from", file}), kBadCommandLine, kNotRegular);
  expect_refused(render(scene, {"--map", file, "-o", path("a.exr")}), kBadCommandLine, kNotRegular);
  expect_refused(render(scene, {"--camera-path", file, "-o", path("a.%d.exr")}), kBadCommandLine,
                 kNotRegular);
}

TEST_F(UnusualFiles, LongNamesAreWrittenOrRefusedAtOnce) {
  const std::string scene = small_scene(film(8, 8));
  const std::string longest = std::string(251, 'n') + ".exr";
  EXPECT_EQ(render(scene, {"-o", path(longest)}).code, kDone);
  EXPECT_TRUE(exists(longest));
  for (const std::string option : {"-o", "--stats"}) {
    const Outcome outcome = render(scene, {option, path("n" + longest)});
    EXPECT_EQ(outcome.code, kBadCommandLine);
    EXPECT_THAT(outcome.err, HasSubstr("File name too long"));
  }
}

// Manifests are JSON, which is UTF-8.
TEST_F(UnusualFiles, NamesThatAreNotUtf8) {
  const std::string scene = small_scene(film(8, 8)), odd = path("a\xff.exr");
  EXPECT_EQ(render(scene, {"-o", odd, "--stats", path("a\xff.json")}).code, kDone);
  EXPECT_TRUE(exists("a\xff.exr"));
  std::filesystem::copy(scene, path("b\xff.pbrt"));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"-o", path("c.exr"), "--checkpoint", path("c.kpart")},
        {"-o", path("c.exr"), "-o", path("d.kpart")},
        {"-o", path("c.exr"), "--save-map", path("c.kmap")}})
    expect_refused(render(path("b\xff.pbrt"), more), kBadCommandLine, "the name is not UTF-8");
  EXPECT_FALSE(exists("c.exr"));
}

TEST_F(UnusualFiles, AMissingFolderForTemporaryFilesIsNamed) {
  const std::string old = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "";
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");  // its sky is an image in a temporary folder
  ::setenv("TMPDIR", path("none").c_str(), 1);
  const Outcome outcome = run_kaustik({"render", path("a.obj"), "-q", "-o", path("a.exr")});
  old.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", old.c_str(), 1);
  EXPECT_NE(outcome.code, kDone);
  EXPECT_THAT(outcome.err, HasSubstr("cannot make a temporary folder in " + path("none")));
  EXPECT_FALSE(exists("a.exr"));
}

TEST_F(UnusualFiles, ACheckpointHasOneWriter) {
  const std::string scene = small_scene(film(8, 8));
  {
    const FileLock other(path(".c.kpart.lock"));
    expect_refused(render(scene, {"-o", path("a.exr"), "--checkpoint", path("c.kpart")}), kBadCommandLine,
                   "another process is writing it");
  }
  EXPECT_EQ(render(scene, {"-o", path("a.exr"), "--checkpoint", path("c.kpart")}).code, kDone);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "c.kpart", "small.pbrt"}));
}

TEST_F(UnusualFiles, ThreadsThatWouldOnlyWaitAreNotMade) {
  const Outcome outcome = render(small_scene(film(8, 8)), {"-o", path("a.exr"), "--threads", "65535"});
  EXPECT_EQ(outcome.code, kDone);
  EXPECT_THAT(outcome.err, HasSubstr("of 65535 most would wait for one of the"));
}

}  // namespace
}  // namespace kaustik::test
