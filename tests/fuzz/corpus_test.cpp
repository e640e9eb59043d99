// Runs every fuzz target over its kept corpus: seeds, and the inputs that have found defects.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

#include "apps/import/common/scene_files.h"
#include "tests/fuzz/targets.h"

namespace kaustik::fuzz {

// GoogleTest prints a case by its name.
void PrintTo(const Target& target, std::ostream* out) {
  *out << target.name;
}

namespace {

constexpr uint64_t kLargestInput = uint64_t{1} << 20;

std::vector<std::filesystem::path> corpus_of(std::string_view name) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(KAUSTIK_SOURCE_DIR) /
                                                               "tests" / "fuzz" / "corpus" / name))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, EndsAsDocumented) {
  const auto paths = corpus_of(GetParam().name);
  EXPECT_FALSE(paths.empty());
  for (const auto& path : paths) {
    // After a crash the last line names the input.
    std::cout << path.filename().string() << std::endl;
    std::string error;
    const auto bytes = pbrt::read_bytes(ReadableFile::trusted(path), kLargestInput, error);
    ASSERT_TRUE(bytes) << error;
    EXPECT_NO_THROW(GetParam().run({reinterpret_cast<const uint8_t*>(bytes->data()), bytes->size()})) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Corpus, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace kaustik::fuzz
