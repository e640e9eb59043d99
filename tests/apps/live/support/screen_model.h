#pragma once
// A terminal as far as the program uses one: cells, scrolling, the cursor, and where pictures lie. It is
// written from the standards, not from the program, and takes note of what it does not know.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/live/terminal/pixels8.h"

namespace kaustik::test {

struct Cell {
  std::string text = " ";
  std::optional<app::Pixels8::Colour> front, back;
};

// A picture by kitty's protocol or by sixels: all of its commands.
struct Graphic {
  std::string bytes;
  size_t line = 0;  // of the text, from its beginning
  bool kitty = false;
};

class ScreenModel {
 public:
  ScreenModel(int columns, int rows) : columns_(size_t(columns)), rows_(size_t(rows)), lines_(1) {
    lines_[0].resize(columns_);
  }

  void write(std::string_view bytes) {
    unread_ += bytes;
    while (!unread_.empty()) {
      const size_t taken = take_one();
      if (taken == 0) return;  // the rest of a sequence is missing
      unread_.erase(0, taken);
    }
  }
  // Lines narrower or wider than the screen was stay as they are.
  void resize(int columns, int rows) { columns_ = size_t(columns), rows_ = size_t(rows); }

  // All text from the beginning on, lines without the blanks at their end.
  size_t lines() const { return lines_.size(); }
  std::string text(size_t line) const {
    std::string text;
    for (const Cell& cell : lines_.at(line)) text += cell.text;
    return text.substr(0, text.find_last_not_of(' ') + 1);
  }
  const Cell& cell(size_t line, size_t column) const { return lines_.at(line).at(column); }
  bool has_line(const std::string& line) const {
    for (size_t i = 0; i < lines(); ++i)
      if (text(i) == line) return true;
    return false;
  }
  size_t cursor_line() const { return line_; }
  size_t cursor_column() const { return column_; }
  const std::vector<Graphic>& graphics() const { return graphics_; }  // those that are to be seen
  int pictures() const { return pictures_; }                          // that were ever drawn
  const std::vector<std::string>& unknown() const { return unknown_; }
  bool has_unread() const { return !unread_.empty(); }

  // The half blocks of consecutive lines as pixels; the first lines with half blocks.
  app::Pixels8 half_blocks() const {
    size_t first = 0;
    while (first < lines() && !text(first).starts_with("\u2580")) ++first;
    size_t end = first;
    while (end < lines() && text(end).starts_with("\u2580")) ++end;
    if (first == end) return {};
    size_t width = 0;
    while (width < lines_[first].size() && cell(first, width).text == "\u2580") ++width;
    const bool odd = !cell(end - 1, 0).back;
    app::Pixels8 pixels(int(width), int(2 * (end - first)) - int(odd));
    for (size_t line = first; line < end; ++line)
      for (size_t x = 0; x < width; ++x) {
        const Cell& c = cell(line, x);
        EXPECT_EQ(c.text, "\u2580");
        const int y = int(2 * (line - first));
        pixels.at(int(x), y) = c.front.value();
        if (y + 1 < pixels.height) pixels.at(int(x), y + 1) = c.back.value();
      }
    return pixels;
  }

 private:
  size_t top() const { return lines_.size() > rows_ ? lines_.size() - rows_ : 0; }

  void go_to_line(size_t line) {
    line_ = line;
    while (lines_.size() <= line_) lines_.emplace_back(columns_);
  }

  // The number of bytes of the next character or sequence; 0 if it is not complete.
  size_t take_one() {
    const char c = unread_[0];
    if (c == '\x1b') return take_escape();
    if (c == '\r') return column_ = 0, 1;
    if (c == '\n') return go_to_line(line_ + 1), column_ = 0, 1;  // ONLCR
    if (c >= 0 && c < ' ') return unknown_.push_back(unread_.substr(0, 1)), 1;
    const size_t size = (c & 0x80) == 0 ? 1 : (c & 0xe0) == 0xc0 ? 2 : (c & 0xf0) == 0xe0 ? 3 : 4;
    if (unread_.size() < size) return 0;
    put(unread_.substr(0, size));
    return size;
  }

  void put(std::string text) {
    if (column_ == columns_) go_to_line(line_ + 1), column_ = 0;
    lines_[line_].resize(std::max(lines_[line_].size(), columns_));
    lines_[line_][column_++] = {std::move(text), front_, back_};
  }

  size_t take_escape() {
    if (unread_.size() < 2) return 0;
    switch (unread_[1]) {
      case '[':
        return take_control();
      case '_':
      case 'P':
        return take_string();
      case '7':
        saved_line_ = line_, saved_column_ = column_;
        return 2;
      case '8':
        line_ = saved_line_, column_ = saved_column_;
        return 2;
      default:
        unknown_.push_back(unread_.substr(0, 2));
        return 2;
    }
  }

  size_t take_control() {
    size_t end = 2;
    while (end < unread_.size() && (unread_[end] < '@' || unread_[end] > '~')) ++end;
    if (end == unread_.size()) return 0;
    const std::string parameters = unread_.substr(2, end - 2);
    const size_t count = size_t(std::max(1, std::atoi(parameters.c_str())));
    switch (unread_[end]) {
      case 'A':
        line_ = std::max(top(), line_ - std::min(line_, count));
        break;
      case 'B':
        line_ = std::min(line_ + count, std::max(lines_.size(), top() + rows_) - 1);
        go_to_line(line_);
        break;
      case 'J':
        erase_below();
        break;
      case 'K':
        for (size_t x = column_; x < lines_[line_].size(); ++x) lines_[line_][x] = {};
        break;
      case 'm':
        set_colours(parameters);
        break;
      default:
        const std::string sequence = unread_.substr(1, end);
        const bool known =
            sequence == "[?2026h" || sequence == "[?2026l" || sequence == "[c" || sequence == "[16t";
        if (!known) unknown_.push_back(sequence);
    }
    return end + 1;
  }

  void erase_below() {
    for (size_t line = line_; line < lines_.size(); ++line)
      for (size_t x = line == line_ ? column_ : 0; x < lines_[line].size(); ++x) lines_[line][x] = {};
    std::erase_if(graphics_, [&](const Graphic& g) { return !g.kitty && g.line >= line_; });
  }

  void set_colours(const std::string& parameters) {
    std::vector<int> n;
    for (size_t at = 0; at <= parameters.size();
         at = std::min(parameters.find(';', at), parameters.size()) + 1)
      n.push_back(std::atoi(parameters.c_str() + at));
    if (n.size() == 1 && n[0] == 0) {
      front_.reset(), back_.reset();
    } else if (n.size() == 5 && n[1] == 2 && (n[0] == 38 || n[0] == 48)) {
      (n[0] == 38 ? front_ : back_) = app::Pixels8::Colour{uint8_t(n[2]), uint8_t(n[3]), uint8_t(n[4])};
    } else {
      unknown_.push_back("[" + parameters + "m");
    }
  }

  size_t take_string() {
    const size_t end = unread_.find("\x1b\\");
    if (end == std::string::npos) return 0;
    const std::string bytes = unread_.substr(0, end + 2);
    if (bytes[1] == 'P')
      draw_sixels(bytes);
    else if (bytes.find("a=q") == std::string::npos)
      take_kitty(bytes);
    return bytes.size();
  }

  // Where sixels leave the cursor differs between terminals: here it is below them, at the left.
  void draw_sixels(const std::string& bytes) {
    std::erase_if(graphics_, [&](const Graphic& g) { return g.line == line_; });
    graphics_.push_back({bytes, line_, false});
    ++pictures_;
    const size_t bands = 1 + size_t(std::count(bytes.begin(), bytes.end(), '-'));
    go_to_line(line_ + (bands * 6 + 19) / 20);
    column_ = 0;
  }

  void take_kitty(const std::string& bytes) {
    const bool more = bytes.find("m=1") != std::string::npos;
    const auto is_id = [&](const Graphic& g) { return g.kitty && key(g.bytes, "i=") == key(bytes, "i="); };
    if (bytes.find("a=d") != std::string::npos) {
      std::erase_if(graphics_, is_id);
    } else if (bytes.find("a=T") != std::string::npos) {
      std::erase_if(graphics_, is_id);
      graphics_.push_back({bytes, line_, true});
      ++pictures_;
    } else if (in_chunks_) {
      graphics_.back().bytes += bytes;
    } else {
      unknown_.push_back(bytes.substr(0, 40));
    }
    in_chunks_ = more;
  }

  static std::string key(const std::string& bytes, const std::string& name) {
    const size_t at = bytes.find("," + name);
    return at == std::string::npos ? "none" : bytes.substr(at, bytes.find_first_of(",;", at + 1) - at);
  }

  size_t columns_, rows_;
  std::vector<std::vector<Cell>> lines_;  // also those that have been scrolled away
  size_t line_ = 0, column_ = 0, saved_line_ = 0, saved_column_ = 0;
  std::optional<app::Pixels8::Colour> front_, back_;
  std::vector<Graphic> graphics_;
  int pictures_ = 0;
  bool in_chunks_ = false;
  std::string unread_;
  std::vector<std::string> unknown_;
};

}  // namespace kaustik::test
