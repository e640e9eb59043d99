#pragma once
// A folder for each test, since tests run side by side.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace kaustik::test {

// Creates the running test's folder below the tests' output folder, named after suite and test, and returns
// it.
inline std::filesystem::path output_folder() {
  const ::testing::TestInfo* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  const auto folder = std::filesystem::path(KAUSTIK_TEST_OUTPUT_DIR) / name;
  std::filesystem::create_directories(folder);
  return folder;
}

// The same folder without what an earlier run left in it.
inline std::filesystem::path empty_output_folder() {
  std::filesystem::remove_all(output_folder());
  return output_folder();
}

}  // namespace kaustik::test
