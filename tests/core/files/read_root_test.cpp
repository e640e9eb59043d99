#include "core/files/read_root.h"

#include <gtest/gtest.h>

#include "core/files/input_file.h"
#include "core/files/pending_file.h"
#include "tests/support/output_folder.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

// Files: root/a.txt, root/sub/b.txt, outside/c.txt. Links: root/up to root/sub/.., root/to_c and root/to_none
// to files outside, root/to_outside, root/loop; way is a link to root.
class ReadRootTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"root/sub", "outside"}) fs::create_directories(folder_ / folder);
    for (const char* file : {"root/a.txt", "root/sub/b.txt", "outside/c.txt"})
      write_file(folder_ / file, file);
    link("root/up", "sub/..");
    link("root/absolute", folder_ / "root/sub");
    link("root/to_c", "../outside/c.txt");
    link("root/to_none", "../outside/none.txt");
    link("root/to_outside", folder_ / "outside");
    link("root/loop", "loop");
    link("way", "root");
  }
  void link(const fs::path& name, const fs::path& to) const { fs::create_symlink(to, folder_ / name); }

  // The text of a file that root/NAMING_FOLDER calls `name`, or why it cannot be read.
  std::string read(const fs::path& name, const fs::path& folder = "") const {
    try {
      return read_file(root_.find(folder_ / "root" / folder, name), 100);
    } catch (const FileError& error) {
      return error.what();
    }
  }

  fs::path folder_ = fs::canonical(test::empty_output_folder());
  fs::path made_ = [this] {
    fs::create_directory(folder_ / "root");
    return folder_ / "root";
  }();
  ReadRoot root_{made_, "refused"};
};

TEST_F(ReadRootTest, FilesBelowItAreFound) {
  for (const fs::path& name :
       {fs::path("a.txt"), fs::path("./sub/../a.txt"), fs::path("up/a.txt"), fs::path("absolute/../a.txt"),
        folder_ / "root/a.txt", folder_ / "root//sub/.././a.txt"})
    EXPECT_EQ(read(name), "root/a.txt") << name;
  EXPECT_EQ(read("../a.txt", "sub"), "root/a.txt");
  EXPECT_EQ(read("none.txt"), "No such file or directory");
}

TEST_F(ReadRootTest, TheRootMayBeGivenInAnyWay) {
  const fs::path relative = fs::proximate(folder_ / "root");
  for (const fs::path& given : {folder_ / "root/", folder_ / "way", folder_ / "way/", folder_ / "root/sub/..",
                                relative, relative / "."}) {
    root_ = ReadRoot(given, "refused");
    EXPECT_EQ(read("a.txt"), "root/a.txt") << given;
    EXPECT_EQ(read_file(root_.find(folder_ / "way/a.txt"), 100), "root/a.txt") << given;
    EXPECT_EQ(read(fs::absolute(given) / "a.txt"), "root/a.txt") << given;
    EXPECT_EQ(read("to_c"), "refused") << given;
  }
  EXPECT_THROW(ReadRoot(folder_ / "none", ""), FileError);
  EXPECT_THROW(ReadRoot(folder_ / "outside/c.txt", ""), FileError);
}

// The answer is that of files that are not there.
TEST_F(ReadRootTest, NothingOutsideIsFound) {
  for (const fs::path& name :
       {fs::path("../outside/c.txt"), fs::path("../outside/none.txt"), fs::path("to_c"), fs::path("to_none"),
        fs::path("to_outside/c.txt"), fs::path("to_outside/none.txt"), fs::path("../root/a.txt"),
        fs::path("to_outside/../root/a.txt"), fs::path("loop"), fs::path(".."), fs::path("/"),
        folder_ / "outside/c.txt", folder_ / "root/../outside/c.txt", folder_ / "way/a.txt",
        fs::path("/etc/passwd"), fs::path("/none"), fs::path(std::string("a.txt\0b", 7))}) {
    EXPECT_EQ(read(name), "refused") << name;
    EXPECT_FALSE(root_.find(folder_ / "root", name).exists()) << name;
  }
  EXPECT_EQ(read("../../outside/c.txt", "sub"), "refused");
  EXPECT_TRUE(root_.find(folder_ / "outside/c.txt").refused());
  EXPECT_TRUE(root_.find(folder_ / "outside", "../root/a.txt").refused());
}

TEST_F(ReadRootTest, OwnFilesAreFoundByTheirNamesAlone) {
  root_.add_own(folder_ / "outside");
  EXPECT_EQ(read_file(root_.find(folder_ / "outside", "c.txt"), 100), "outside/c.txt");
  EXPECT_TRUE(root_.find(folder_ / "outside", "../outside/c.txt").refused());
  EXPECT_EQ(read(folder_ / "outside/c.txt"), "refused");
}

// A folder that becomes a link after it was checked.
TEST_F(ReadRootTest, WhatBecomesALinkIsNotFollowed) {
  write_file(folder_ / "root/sub/c.txt", "inside");
  const ReadableFile file = root_.find(folder_ / "root", "sub/c.txt");
  EXPECT_EQ(read_file(file, 100), "inside");
  fs::rename(folder_ / "root/sub", folder_ / "root/other");
  link("root/sub", folder_ / "outside");
  EXPECT_THROW(read_file(file, 100), FileError);
}

TEST_F(ReadRootTest, WithoutARootAllFilesAreFound) {
  root_ = {};
  EXPECT_EQ(read("to_c"), "outside/c.txt");
  EXPECT_EQ(read(folder_ / "outside/c.txt"), "outside/c.txt");
}

}  // namespace
}  // namespace kaustik
