#include "apps/live/terminal/terminal_graphics.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <vector>

namespace kaustik::app {

namespace {

constexpr std::string_view kKittyYes = "\x1b_Gi=31;OK";

// A sequence ESC [ parameters letter. Others than numbers separated by semicolons have no parameters here.
struct ControlSequence {
  bool is_private = false;  // its parameters begin with `?`
  std::vector<int> parameters;
  char letter = 0;
};

// Reads what follows ESC [; letter 0 if the sequence is not complete.
ControlSequence read_sequence(std::string_view text) {
  ControlSequence sequence;
  sequence.is_private = text.starts_with('?');
  size_t at = sequence.is_private ? 1 : 0;
  for (; at < text.size() && (text[at] < '@' || text[at] > '~'); ++at) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc()) continue;
    sequence.parameters.push_back(value);
    at = size_t(end - text.data()) - 1;
  }
  if (at < text.size()) sequence.letter = text[at];
  return sequence;
}

// Neither lines nor echo nor signals, as long as it exists. Threads that are not in front of their terminal
// may set it, too: the signal that would stop them is blocked.
class RawInput {
 public:
  explicit RawInput(int file) : file_(file) {
    sigemptyset(&background_);
    sigaddset(&background_, SIGTTOU), sigaddset(&background_, SIGTTIN);
    pthread_sigmask(SIG_BLOCK, &background_, &blocked_before_);
    known_ = tcgetattr(file, &before_) == 0;
    termios raw = before_;
    raw.c_lflag &= ~tcflag_t(ICANON | ECHO | ISIG);
    raw.c_cc[VMIN] = 0, raw.c_cc[VTIME] = 0;
    if (known_) tcsetattr(file, TCSANOW, &raw);
  }
  ~RawInput() {
    if (known_) tcsetattr(file_, drop_rest_ ? TCSAFLUSH : TCSANOW, &before_);
    pthread_sigmask(SIG_SETMASK, &blocked_before_, nullptr);
  }
  RawInput(const RawInput&) = delete;
  RawInput& operator=(const RawInput&) = delete;

  bool known() const { return known_; }
  // What has come and was not read is lost at the end.
  void drop_rest() { drop_rest_ = true; }
  // The signal that a key means; 0 if none.
  int signal_of(char key) const {
    constexpr std::array<std::pair<int, int>, 3> kSignals = {
        {{VINTR, SIGINT}, {VQUIT, SIGQUIT}, {VSUSP, SIGTSTP}}};
    for (const auto& [index, signal] : kSignals)
      if (before_.c_cc[index] != _POSIX_VDISABLE && before_.c_cc[index] == cc_t(key)) return signal;
    return 0;
  }

 private:
  const int file_;
  sigset_t background_{}, blocked_before_{};
  termios before_{};
  bool known_ = false, drop_rest_ = false;
};

// Whether the shell has given the terminal to another job. A terminal that is not that of the process's
// session is nobody's.
bool in_background(int file) {
  const pid_t front = tcgetpgrp(file);
  return front >= 0 && front != getpgrp();
}

}  // namespace

std::string terminal_questions() {
  return "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[16t\x1b[c";
}

TerminalAnswers read_answers(std::string_view text) {
  TerminalAnswers answers;
  answers.kitty = text.find(kKittyYes) != std::string_view::npos;
  for (size_t at = text.find("\x1b["); at != std::string_view::npos; at = text.find("\x1b[", at + 2)) {
    const auto [is_private, parameters, letter] = read_sequence(text.substr(at + 2));
    if (letter == 't' && parameters.size() == 3 && parameters[0] == 6)
      answers.cell_height = parameters[1], answers.cell_width = parameters[2];
    if (letter != 'c' || !is_private) continue;
    answers.complete = true;
    for (size_t i = 1; i < parameters.size(); ++i) answers.sixel |= parameters[i] == 4;
  }
  return answers;
}

const TerminalAnswers& TerminalDialogue::ask(Screen& screen, Time patience) {
  pollfd takes{file_, POLLOUT, 0};
  if (file_ < 0 || in_background(file_) || poll(&takes, 1, 0) <= 0) return answers_;
  asked_ = Clock::now();
  listen(*asked_ + patience, [&] { screen.send(terminal_questions()); });
  return answers_;
}

void TerminalDialogue::await_rest(Time since_question) {
  if (asked_ && !answers_.complete && !in_background(file_)) listen(*asked_ + since_question, [] {});
}

void TerminalDialogue::listen(Clock::time_point end, const std::function<void()>& before) {
  int signal = 0;
  {
    RawInput raw(file_);
    if (!raw.known()) return;
    before();
    while (!answers_.complete && signal == 0) {
      const auto left = std::chrono::ceil<Time>(end - Clock::now());
      pollfd input{file_, POLLIN, 0};
      if (poll(&input, 1, int(std::max(left, Time(0)).count())) <= 0) break;
      std::array<char, 256> bytes;
      const ssize_t count = ::read(file_, bytes.data(), bytes.size());
      if (count <= 0) break;
      const std::string_view read(bytes.data(), size_t(count));
      for (const char byte : read)
        if (signal == 0) signal = raw.signal_of(byte);
      text_ += read;
      answers_ = read_answers(text_);
    }
    if (!answers_.complete) raw.drop_rest();
  }
  if (signal != 0) kill(getpid(), signal);
}

int open_error_terminal() {
  std::array<char, 256> name{};
  int file = -1;
  if (ttyname_r(STDERR_FILENO, name.data(), name.size()) == 0)
    file = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  return file >= 0 ? file : open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
}

}  // namespace kaustik::app
