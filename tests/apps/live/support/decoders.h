#pragma once
// Reads back the pictures that are sent to terminals, by the descriptions of their formats.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdlib>
#include <map>
#include <string>

#include "apps/live/terminal/pixels8.h"

namespace kaustik::test {

inline std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const size_t digit = digits.find(c);
    EXPECT_NE(digit, std::string::npos) << c;
    bits = bits << 6 | unsigned(digit), count += 6;
    if (count >= 8) bytes += char(bits >> (count -= 8) & 255u);
  }
  return bytes;
}

struct KittyImage {
  std::map<std::string, std::string> keys;  // of the first command
  app::Pixels8 pixels;
  size_t chunks = 0;
};

// Reads one picture that is sent in one or more commands.
inline KittyImage decoded_kitty(const std::string& bytes) {
  KittyImage image;
  std::string payload;
  for (size_t at = bytes.find("\x1b_G"); at != std::string::npos; at = bytes.find("\x1b_G", at + 1)) {
    const size_t data = bytes.find(';', at), end = bytes.find("\x1b\\", at);
    EXPECT_LE(end - data - 1, 4096u);
    std::string keys = bytes.substr(at + 3, data - at - 3) + ",";
    const bool last = bytes.find("\x1b_G", end) == std::string::npos;
    EXPECT_NE(keys.find(last ? "m=0," : "m=1,"), std::string::npos) << keys;
    EXPECT_NE(keys.find("q=2,"), std::string::npos) << keys;
    EXPECT_TRUE(last || (end - data - 1) % 4 == 0);
    for (size_t k = 0; image.chunks == 0 && k < keys.size(); k = keys.find(',', k) + 1)
      image.keys[keys.substr(k, keys.find('=', k) - k)] =
          keys.substr(keys.find('=', k) + 1, keys.find(',', k) - keys.find('=', k) - 1);
    payload += bytes.substr(data + 1, end - data - 1);
    ++image.chunks;
  }
  image.pixels = app::Pixels8(std::atoi(image.keys["s"].c_str()), std::atoi(image.keys["v"].c_str()));
  std::string raw = from_base64(payload);
  uLongf size = uLongf(image.pixels.colours.size() * 3);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(image.pixels.colours.data()), &size,
                       reinterpret_cast<const Bytef*>(raw.data()), uLong(raw.size())),
            Z_OK);
  EXPECT_EQ(size, image.pixels.colours.size() * 3);
  return image;
}

class SixelDecoder {
 public:
  explicit SixelDecoder(const std::string& bytes) : bytes_(bytes) {
    EXPECT_TRUE(bytes.starts_with("\x1bP"));
    EXPECT_TRUE(bytes.ends_with("\x1b\\"));
    at_ = bytes.find('q') + 1;
    while (at_ < bytes.size() - 2) take();
  }
  const app::Pixels8& pixels() const { return pixels_; }
  size_t colours() const { return palette_.size(); }
  bool complete() const { return drawn_ == pixels_.colours.size(); }  // each pixel was drawn once

 private:
  std::vector<int> numbers() {
    std::vector<int> all;
    do {
      ++at_;
      all.push_back(0);
      while (std::isdigit(bytes_[at_])) all.back() = all.back() * 10 + bytes_[at_++] - '0';
    } while (bytes_[at_] == ';');
    return all;
  }

  void take() {
    const char c = bytes_[at_];
    if (c == '"') {
      const std::vector<int> n = numbers();
      ASSERT_EQ(n.size(), 4u);
      pixels_ = app::Pixels8(n[2], n[3]);
    } else if (c == '#') {
      const std::vector<int> n = numbers();
      colour_ = n[0];
      if (n.size() == 1) return;
      ASSERT_EQ(n.size(), 5u);
      ASSERT_EQ(n[1], 2);
      for (size_t i = 0; i < 3; ++i) palette_[colour_][i] = uint8_t((n[i + 2] * 255 + 50) / 100);
    } else if (c == '!') {
      const int count = numbers()[0];
      draw(bytes_[at_++], count);
    } else if (c == '$' || c == '-') {
      x_ = 0;
      if (c == '-') y_ += 6;
      ++at_;
    } else {
      draw(bytes_[at_++], 1);
    }
  }

  void draw(char sixel, int count) {
    ASSERT_GE(sixel, '?');
    ASSERT_LE(sixel, '~');
    for (; count > 0; --count, ++x_)
      for (int bit = 0; bit < 6; ++bit) {
        if (((sixel - '?') >> bit & 1) == 0) continue;
        ASSERT_TRUE(x_ < pixels_.width && y_ + bit < pixels_.height);
        ASSERT_TRUE(palette_.contains(colour_));
        pixels_.at(x_, y_ + bit) = palette_[colour_];
        ++drawn_;
      }
  }

  const std::string bytes_;
  size_t at_ = 0, drawn_ = 0;
  int x_ = 0, y_ = 0, colour_ = -1;
  std::map<int, app::Pixels8::Colour> palette_;
  app::Pixels8 pixels_;
};

}  // namespace kaustik::test
