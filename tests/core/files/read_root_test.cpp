#include "core/files/read_root.h"

#include <gtest/gtest.h>

#include "core/files/input_file.h"
#include "core/files/pending_file.h"
#include "tests/support/output_folder.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

// Files: inside/a.txt, inside/sub/b.txt, outside/c.txt. Links: inside/up to inside/sub/.., inside/to_c and
// inside/to_none to files outside, inside/to_outside, inside/loop; way is a link to inside.
class ReadRootTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"inside/sub", "outside"}) fs::create_directories(folder_ / folder);
    for (const char* file : {"inside/a.txt", "inside/sub/b.txt", "outside/c.txt"})
      write_file(folder_ / file, file);
    link("inside/up", "sub/..");
    link("inside/absolute", folder_ / "inside/sub");
    link("inside/to_c", "../outside/c.txt");
    link("inside/to_none", "../outside/none.txt");
    link("inside/to_outside", folder_ / "outside");
    link("inside/loop", "loop");
    link("way", "inside");
  }
  void link(const fs::path& name, const fs::path& to) const { fs::create_symlink(to, folder_ / name); }

  // The text of a file that inside/NAMING_FOLDER calls `name`, or why it cannot be read.
  std::string read(const fs::path& name, const fs::path& folder = "") const {
    try {
      return read_file(root_.find(folder_ / "inside" / folder, name), 100);
    } catch (const FileError& error) {
      return error.what();
    }
  }

  fs::path folder_ = fs::canonical(test::empty_output_folder());
  fs::path made_ = [this] {
    fs::create_directory(folder_ / "inside");
    return folder_ / "inside";
  }();
  ReadRoot root_{made_, "refused"};
};

TEST_F(ReadRootTest, FilesBelowItAreFound) {
  for (const fs::path& name :
       {fs::path("a.txt"), fs::path("./sub/../a.txt"), fs::path("up/a.txt"), fs::path("absolute/../a.txt"),
        folder_ / "inside/a.txt", folder_ / "inside//sub/.././a.txt"})
    EXPECT_EQ(read(name), "inside/a.txt") << name;
  EXPECT_EQ(read("../a.txt", "sub"), "inside/a.txt");
  EXPECT_EQ(read("none.txt"), "No such file or directory");
}

TEST_F(ReadRootTest, TheRootMayBeGivenInAnyWay) {
  const fs::path relative = fs::proximate(folder_ / "inside");
  for (const fs::path& given : {folder_ / "inside/", folder_ / "way", folder_ / "way/",
                                folder_ / "inside/sub/..", relative, relative / "."}) {
    root_ = ReadRoot(given, "refused");
    EXPECT_EQ(read("a.txt"), "inside/a.txt") << given;
    EXPECT_EQ(read_file(root_.find(folder_ / "way/a.txt"), 100), "inside/a.txt") << given;
    EXPECT_EQ(read(fs::absolute(given) / "a.txt"), "inside/a.txt") << given;
    EXPECT_EQ(read("to_c"), "refused") << given;
  }
  EXPECT_THROW(ReadRoot(folder_ / "none", ""), FileError);
  EXPECT_THROW(ReadRoot(folder_ / "outside/c.txt", ""), FileError);
}

// The answer is that of files that are not there.
TEST_F(ReadRootTest, NothingOutsideIsFound) {
  for (const fs::path& name :
       {fs::path("../outside/c.txt"), fs::path("../outside/none.txt"), fs::path("to_c"), fs::path("to_none"),
        fs::path("to_outside/c.txt"), fs::path("to_outside/none.txt"), fs::path("../inside/a.txt"),
        fs::path("to_outside/../inside/a.txt"), fs::path("loop"), fs::path(".."), fs::path("/"),
        folder_ / "outside/c.txt", folder_ / "inside/../outside/c.txt", folder_ / "way/a.txt",
        fs::path("/etc/passwd"), fs::path("/none"), fs::path(std::string("a.txt\0b", 7))}) {
    EXPECT_EQ(read(name), "refused") << name;
    EXPECT_FALSE(root_.find(folder_ / "inside", name).exists()) << name;
  }
  EXPECT_EQ(read("../../outside/c.txt", "sub"), "refused");
  EXPECT_TRUE(root_.find(folder_ / "outside/c.txt").refused());
  EXPECT_TRUE(root_.find(folder_ / "outside", "../inside/a.txt").refused());
}

TEST_F(ReadRootTest, OwnFilesAreFoundByTheirNamesAlone) {
  root_.add_own(folder_ / "outside");
  EXPECT_EQ(read_file(root_.find(folder_ / "outside", "c.txt"), 100), "outside/c.txt");
  EXPECT_TRUE(root_.find(folder_ / "outside", "../outside/c.txt").refused());
  EXPECT_EQ(read(folder_ / "outside/c.txt"), "refused");
}

// A folder that becomes a link after it was checked.
TEST_F(ReadRootTest, WhatBecomesALinkIsNotFollowed) {
  write_file(folder_ / "inside/sub/c.txt", "inside");
  const ReadableFile file = root_.find(folder_ / "inside", "sub/c.txt");
  EXPECT_EQ(read_file(file, 100), "inside");
  fs::rename(folder_ / "inside/sub", folder_ / "inside/other");
  link("inside/sub", folder_ / "outside");
  EXPECT_THROW(read_file(file, 100), FileError);
}

TEST_F(ReadRootTest, WithoutARootAllFilesAreFound) {
  root_ = {};
  EXPECT_EQ(read("to_c"), "outside/c.txt");
  EXPECT_EQ(read(folder_ / "outside/c.txt"), "outside/c.txt");
}

}  // namespace
}  // namespace kaustik
