// The cursor rests on the progress line, or on the empty line in its place. ECMA-48 has the sequences of
// `ESC [`: A and B move up and down by lines, J and K erase to the end of the screen and of the line.

#include "apps/console/screen.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <exception>
#include <iostream>

namespace kaustik::app {

namespace {

// DEC private mode 2026: terminals that know it show what comes between the two at once, others ignore it.
constexpr std::string_view kHold = "\x1b[?2026h", kShow = "\x1b[?2026l";
constexpr std::string_view kSaveCursor =
                               "\x1b"
                               "7",
                           kRestoreCursor =
                               "\x1b"
                               "8";

}  // namespace

void Screen::log(std::string_view lines) {
  std::unique_lock lock(mutex_);
  pending_ += lines;
  write_pending(lock);
}

void Screen::show_line(std::string line) {
  std::unique_lock lock(mutex_);
  line_ = std::move(line);
  line_changed_ = true;
  write_pending(lock);
}

void Screen::send(std::string_view bytes) {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [&] { return !writing_; });
  // A terminal that does not understand may show some of them: in this line, which is then erased.
  write(fmt::format("\r\x1b[K{}{}", bytes, line_again()), lock);
  write_pending(lock);
}

size_t Screen::draw(const Place& place, std::string forget, const Paint& paint, bool anew) {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [&] { return !writing_; });
  const bool all = anew || place_ != place;
  std::string bytes(kHold);
  if (all) bytes += erased() + std::string(size_t(place.rows), '\n');
  writing_ = true;
  lock.unlock();
  std::string picture;
  std::exception_ptr trouble;
  try {
    picture = paint(all);
  } catch (...) {
    trouble = std::current_exception();
  }
  lock.lock();
  writing_ = false;
  if (picture.empty()) {
    idle_.notify_all();
    write_pending(lock);
    if (trouble) std::rethrow_exception(trouble);
    return 0;
  }
  place_ = place, forget_ = std::move(forget);
  bytes += fmt::format("\r\x1b[{}A{}{}{}\x1b[{}B{}{}", place.rows, kSaveCursor, picture, kRestoreCursor,
                       place.rows, line_again(), kShow);
  write(bytes, lock);
  write_pending(lock);
  return bytes.size();
}

void Screen::keep_picture() {
  const std::lock_guard lock(mutex_);
  place_ = {};
}

// Removes picture and progress line; the cursor then is where the picture began.
std::string Screen::erased() const {
  if (place_.rows == 0) return "\r\x1b[K";
  return fmt::format("{}\r\x1b[{}A\x1b[J", forget_, place_.rows);
}

// The progress line as it is now.
std::string Screen::line_again() {
  line_changed_ = false;
  line_visible_ = !line_.empty();
  return fmt::format("\r{}\x1b[K", line_);
}

// The next bytes to write; empty if there are none.
std::string Screen::next_bytes() {
  if (!pending_.empty()) {
    const bool erase = line_visible_ || place_.rows > 0;
    std::string bytes = (erase ? erased() : "") + pending_;
    if (!line_.empty()) bytes += line_again();
    line_visible_ = !line_.empty(), line_changed_ = false;
    pending_.clear();
    place_ = {};
    return bytes;
  }
  if (!line_changed_) return {};
  line_changed_ = false;
  const bool wanted = line_.empty() ? line_visible_ : takes_more();
  return wanted ? line_again() : "";
}

void Screen::write(const std::string& bytes, std::unique_lock<std::mutex>& lock) {
  writing_ = true;
  lock.unlock();
  stream_ << bytes << std::flush;
  lock.lock();
  writing_ = false;
  idle_.notify_all();
}

void Screen::write_pending(std::unique_lock<std::mutex>& lock) {
  while (!writing_) {
    const std::string bytes = next_bytes();
    if (bytes.empty()) return;
    write(bytes, lock);
  }
}

bool Screen::takes_more() const {
  if (file_ < 0) return true;
  pollfd terminal{file_, POLLOUT, 0};
  return poll(&terminal, 1, 0) > 0 && (terminal.revents & POLLOUT);
}

std::shared_ptr<Screen> screen_on(std::ostream& stream) {
  return std::make_shared<Screen>(stream, &stream == &std::cerr ? STDERR_FILENO : -1);
}

}  // namespace kaustik::app
