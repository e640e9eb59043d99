#include "core/files/content_hash.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace kaustik {
namespace {

std::string hash_of(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

TEST(ContentHash, DoesNotDependOnHowTheBytesAreSplit) {
  std::mt19937 random(1);
  std::string text(1000, '\0');
  for (char& c : text) c = static_cast<char>(random());
  for (int round = 0; round < 50; ++round) {
    ContentHash hash;
    for (size_t at = 0; at < text.size();) {
      const size_t size = std::min<size_t>(random() % 20, text.size() - at);
      hash.add(text.data() + at, size);
      at += size;
    }
    EXPECT_EQ(hash.text(), hash_of(text));
  }
  EXPECT_EQ(hash_of(text).size(), 32u);
}

// Every bit of every byte, zeros at the end and the order of the bytes change the hash.
TEST(ContentHash, DiffersForDifferentContents) {
  std::set<std::string> seen;
  std::string text = "twenty bytes of text";
  EXPECT_TRUE(seen.insert(hash_of(text)).second);
  for (char& c : text) {
    for (int bit = 0; bit < 8; ++bit) {
      c = static_cast<char>(c ^ (1 << bit));
      EXPECT_TRUE(seen.insert(hash_of(text)).second);
      c = static_cast<char>(c ^ (1 << bit));
    }
  }
  for (size_t zeros = 0; zeros < 20; ++zeros)
    EXPECT_TRUE(seen.insert(hash_of(std::string(zeros, '\0'))).second) << zeros;
  EXPECT_TRUE(seen.insert(hash_of("12345678abcdefgh")).second);
  EXPECT_TRUE(seen.insert(hash_of("abcdefgh12345678")).second);
}

}  // namespace
}  // namespace kaustik
