#pragma once
// The end of a terminal's text, which is redrawn in place: a picture and, below it, the progress line. Log
// lines appear above both. All functions are thread-safe.

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>

namespace kaustik::app {

// Only one thread writes at a time. What others have to say meanwhile is kept, and written by that thread, so
// that a slow terminal which still takes a picture delays nobody but the thread that draws it.
class Screen {
 public:
  // file: the terminal behind the stream, which is asked whether it takes more; -1: it always does.
  explicit Screen(std::ostream& stream, int file = -1) : stream_(stream), file_(file) {}
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  // Writes whole lines, each with its end. They take the place of the picture, which is lost; the progress
  // line stays.
  void log(std::string_view lines);
  // Replaces the progress line; an empty one removes it. A terminal that takes nothing now shows only a
  // later one.
  void show_line(std::string line);
  // Sends bytes that leave nothing visible, such as questions to the terminal.
  void send(std::string_view bytes);

  // Where a picture lies: as many lines, and as many columns of them.
  struct Place {
    int rows = 0, columns = 0;
    bool operator==(const Place&) const = default;
  };
  // Gives the bytes that draw a picture from the upper left cell of its place. all: the place is empty;
  // otherwise it still shows what was drawn last. Nothing is written if there are no bytes.
  using Paint = std::function<std::string(bool all)>;
  // Draws by `paint` what is in this place, after the place is made if there is none of this size. forget:
  // bytes by which the terminal forgets the picture where erasing its cells is not enough. anew: makes the
  // place again, since others may have written there, as the terminal itself does with typed keys. Returns
  // the number of bytes written. Waits while another thread writes.
  size_t draw(const Place& place, std::string forget, const Paint& paint, bool anew = false);
  // Leaves the picture, if there is one, as a part of the text above.
  void keep_picture();

 private:
  std::string erased() const;
  std::string line_again();
  std::string next_bytes();
  void write(const std::string& bytes, std::unique_lock<std::mutex>& lock);
  void write_pending(std::unique_lock<std::mutex>& lock);
  bool takes_more() const;

  std::ostream& stream_;
  const int file_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable idle_;
  bool writing_ = false;
  std::string pending_;  // log lines and bytes to send
  std::string line_;     // the progress line
  bool line_changed_ = false, line_visible_ = false;
  Place place_;         // of the picture that the terminal shows; no rows: none
  std::string forget_;  // see draw()
};

// The screen of a stream that is a terminal.
std::shared_ptr<Screen> screen_on(std::ostream& stream);

}  // namespace kaustik::app
