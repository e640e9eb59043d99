#include "core/files/file_lock.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/output_folder.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

TEST(FileLock, OnlyOneHoldsIt) {
  const fs::path folder = test::empty_output_folder();
  auto first = std::make_unique<FileLock>(folder / "a");
  EXPECT_THROW(FileLock(folder / "a"), FileBusy);
  const FileLock other(folder / "b");
  first.reset();
  const FileLock again(folder / "a");
  EXPECT_THROW(FileLock(folder / "none" / "a"), FileError);
}

TEST(FileLock, NothingIsLeft) {
  const fs::path folder = test::empty_output_folder();
  { const FileLock lock(folder / "a"); }
  EXPECT_EQ(fs::directory_iterator(folder), fs::directory_iterator());
}

// A planted link is not followed.
TEST(FileLock, ALinkIsRefused) {
  const fs::path folder = test::empty_output_folder();
  fs::create_symlink("victim", folder / "a");
  EXPECT_THROW(FileLock(folder / "a"), FileError);
  EXPECT_FALSE(fs::exists(folder / "victim"));
}

}  // namespace
}  // namespace kaustik
