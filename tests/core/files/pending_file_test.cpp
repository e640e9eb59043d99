#include "core/files/pending_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/files/system_calls.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/output_folder.h"
#include "tests/support/system_faults.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

size_t files_in(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// The reason why a file cannot be written; empty on success.
std::string failure(const fs::path& path, std::string_view bytes) {
  try {
    write_file(path, bytes);
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

class WriteFile : public ::testing::Test {
 protected:
  const fs::path folder_ = test::empty_output_folder();
  const fs::path path_ = folder_ / "a.txt";
};

TEST_F(WriteFile, ReplacesTheFile) {
  for (const std::string& text : {std::string("first"), std::string(), std::string(3'000'000, 'x')}) {
    EXPECT_EQ(failure(path_, text), "");
    EXPECT_EQ(text_of(path_), text);
  }
  EXPECT_EQ(files_in(folder_), 1u);
}

// The old file stays, and nothing else is left in the folder.
TEST_F(WriteFile, AFullDiskIsReportedAndChangesNothing) {
  ASSERT_EQ(failure(path_, "old"), "");
  {
    const test::FileSizeLimit limit(1000);
    EXPECT_EQ(failure(path_, std::string(1001, 'x')), std::strerror(EFBIG));
    EXPECT_EQ(failure(folder_ / "b.txt", std::string(1000, 'x')), "");
  }
  EXPECT_EQ(text_of(path_), "old");
  EXPECT_EQ(files_in(folder_), 2u);
  EXPECT_EQ(failure(folder_ / "none" / "a.txt", "x"), std::strerror(ENOENT));
}

// Each call that is made for a file fails once, with and without files that have no name.
TEST_F(WriteFile, EveryFailureLeavesTheOldFile) {
  for (const bool unnamed : {true, false}) {
    for (int n = 1;; ++n) {
      ASSERT_EQ(failure(path_, "old"), "");
      test::SystemFaults faults;
      if (!unnamed) faults.fail(SystemCall::kOpen, 1, EOPNOTSUPP);
      faults.fail_call(n, EIO);
      const std::string reason = failure(path_, std::string(200'000, 'x'));
      const bool failed = faults.happened();
      faults.stop();
      if (!failed) {
        EXPECT_GT(n, 5);
        EXPECT_EQ(reason, "");
        break;
      }
      // Where the first attempt to open fails, the file gets a temporary name.
      if (reason.empty()) continue;
      EXPECT_EQ(reason, std::strerror(EIO)) << n;
      EXPECT_EQ(text_of(path_), "old") << n;
      EXPECT_EQ(files_in(folder_), 1u) << n;
    }
  }
}

// So that a process that is killed leaves nothing: a new file gets its name in one step.
TEST_F(WriteFile, NewFilesHaveNoTemporaryName) {
  test::SystemFaults faults;
  faults.fail(SystemCall::kLink, 2, EIO);
  faults.fail(SystemCall::kRename, 1, EIO);
  EXPECT_EQ(failure(path_, "new"), "");
  EXPECT_EQ(text_of(path_), "new");
  EXPECT_EQ(failure(path_, "again"), std::strerror(EIO));
}

TEST_F(WriteFile, NamesMayHaveTheLengthThatTheSystemAllows) {
  for (const char* const character : {"x", "\u00e9", "\u4e2d"}) {  // one, two and three bytes
    std::string name;
    while (name.size() + std::strlen(character) <= 255) name += character;
    EXPECT_EQ(failure(folder_ / name, "text"), "");
    EXPECT_EQ(text_of(folder_ / name), "text");
    test::SystemFaults faults;
    faults.fail(SystemCall::kOpen, 1, EOPNOTSUPP);
    EXPECT_EQ(failure(folder_ / name, "again"), "");
    EXPECT_EQ(text_of(folder_ / name), "again");
  }
}

TEST_F(WriteFile, ALinkIsReplacedAndWhatItNamesStays) {
  std::ofstream(folder_ / "victim") << "precious";
  fs::create_symlink("victim", path_);
  EXPECT_EQ(failure(path_, "new"), "");
  EXPECT_EQ(text_of(folder_ / "victim"), "precious");
  EXPECT_FALSE(fs::is_symlink(path_));
}

TEST_F(WriteFile, PermissionsAreThoseOfNewFiles) {
  const mode_t mask = ::umask(027);
  EXPECT_EQ(failure(path_, "new"), "");
  ::umask(mask);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms(0640));
}

TEST(PendingFile, BytesMayBeWrittenAnywhere) {
  const fs::path path = test::empty_output_folder() / "a.bin";
  std::string expected(300'000, '\0');
  for (size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<char>(i * 7 / 5);
  PendingFile file(path);
  file.write(std::string(8, '?'));
  file.write(std::string_view(expected).substr(8, 100'000));
  file.write(std::string_view(expected).substr(100'008, 100));
  EXPECT_EQ(file.position(), 100'108u);
  file.write(std::string_view(expected).substr(100'108));
  file.seek(0);
  file.write(std::string_view(expected).substr(0, 8));
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(text_of(path), expected);
}

TEST(PendingFile, NothingIsLeftWithoutCommit) {
  const fs::path folder = test::empty_output_folder();
  {
    PendingFile first(folder / "a"), second(folder / "b");
    first.write("x");
    second.write("x");
    second.finish();
  }
  EXPECT_EQ(files_in(folder), 0u);
}

// What a killed process has left is known by its name; files that only look like it stay.
TEST(PendingFile, LeftoversAreRemoved) {
  const fs::path folder = test::empty_output_folder();
  test::SystemFaults faults;
  faults.fail(SystemCall::kOpen, 1, EOPNOTSUPP);
  const PendingFile file(folder / "a.kpart");
  ASSERT_EQ(files_in(folder), 1u);
  const fs::path left = fs::directory_iterator(folder)->path();
  for (const char* const name : {"a.kpart", ".a.kpart.partial", ".b.kpart.0123456789abcdef.partial"})
    std::ofstream(folder / name) << "x";
  remove_leftovers(folder / "a.kpart");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(files_in(folder), 3u);
  std::ofstream(folder / ".c.kpart.0123456789abcdeg.partial") << "x";
  remove_all_leftovers(folder);
  EXPECT_FALSE(fs::exists(folder / ".b.kpart.0123456789abcdef.partial"));
  EXPECT_EQ(files_in(folder), 3u);
}

}  // namespace
}  // namespace kaustik
