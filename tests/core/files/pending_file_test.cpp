#include "core/files/pending_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "tests/support/file_size_limit.h"
#include "tests/support/output_folder.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(WriteFile, ReplacesTheFile) {
  const fs::path folder = test::empty_output_folder(), path = folder / "a.txt";
  for (const std::string& text : {std::string("first"), std::string(), std::string(3'000'000, 'x')}) {
    EXPECT_EQ(write_file(path, text), "");
    EXPECT_EQ(text_of(path), text);
  }
}

// The old file stays, and nothing else is left in the folder.
TEST(WriteFile, FullDiskIsReportedAndChangesNothing) {
  const fs::path folder = test::empty_output_folder(), path = folder / "a.txt";
  ASSERT_EQ(write_file(path, "old"), "");
  {
    const test::FileSizeLimit limit(1000);
    EXPECT_EQ(write_file(path, std::string(1001, 'x')), std::strerror(EFBIG));
    EXPECT_EQ(write_file(folder / "b.txt", std::string(1000, 'x')), "");
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(write_in_place("/dev/full", "x"), std::strerror(ENOSPC));
  }
  EXPECT_EQ(write_file(folder / "none" / "a.txt", "x"), std::strerror(ENOENT));
}

}  // namespace
}  // namespace kaustik
