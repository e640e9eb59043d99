#include "core/files/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "core/files/mapped_file.h"
#include "core/files/pending_file.h"
#include "tests/support/output_folder.h"
#include "tests/support/system_faults.h"

namespace kaustik {
namespace {

namespace fs = std::filesystem;

template <class Work>
std::string failure(const Work& work) {
  try {
    work();
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(InputFile, ReadsAllOrTheBeginning) {
  const fs::path path = test::empty_output_folder() / "a.txt";
  write_file(path, "0123456789");
  EXPECT_EQ(read_file(path, 10), "0123456789");
  EXPECT_EQ(failure([&] { read_file(path, 9); }), "more than 9 bytes");
  EXPECT_EQ(read_head(ReadableFile::trusted(path), 4), "0123");
  EXPECT_EQ(read_head(ReadableFile::trusted(path), 40), "0123456789");
  const MappedFile mapped(path);
  EXPECT_EQ(std::memcmp(mapped.bytes().data(), "0123456789", 10), 0);
  EXPECT_EQ(mapped.bytes().size(), 10u);
}

// To open a pipe would wait for a writer for ever.
TEST(InputFile, PipesDevicesAndFoldersAreRefusedAtOnce) {
  const fs::path folder = test::empty_output_folder(), pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& path : {pipe, fs::path("/dev/zero"), folder}) {
    EXPECT_EQ(failure([&] { read_file(path, 100); }), "not a regular file") << path;
    EXPECT_EQ(failure([&] { read_head(ReadableFile::trusted(path), 100); }), "not a regular file") << path;
    EXPECT_EQ(failure([&] { check_regular(path); }), "not a regular file") << path;
    EXPECT_EQ(failure([&] { MappedFile{path}; }), "not a regular file") << path;
  }
  EXPECT_EQ(failure([&] { read_file(folder / "none", 100); }), std::strerror(ENOENT));
}

TEST(InputFile, FailuresOfTheSystemAreReported) {
  const fs::path path = test::empty_output_folder() / "a.txt";
  write_file(path, "text");
  for (const SystemCall call : {SystemCall::kOpen, SystemCall::kRead}) {
    test::SystemFaults faults;
    faults.fail(call, 1, EIO);
    EXPECT_EQ(failure([&] { read_file(path, 100); }), std::strerror(EIO));
  }
  test::SystemFaults faults;
  faults.fail(SystemCall::kMap, 1, ENOMEM);
  EXPECT_EQ(failure([&] { MappedFile{path}; }), std::strerror(ENOMEM));
}

}  // namespace
}  // namespace kaustik
