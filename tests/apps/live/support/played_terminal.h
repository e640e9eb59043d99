#pragma once
// A pseudo terminal whose other side the test plays.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace kaustik::test {

// Whether this system has pseudo terminals: some containers lack /dev/pts.
inline bool has_terminals() {
  const int near = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  const bool has = near >= 0 && grantpt(near) == 0 && unlockpt(near) == 0;
  if (near >= 0) close(near);
  return has;
}

// For the fixture of tests with terminals.
template <class Fixture>
class WithTerminals : public Fixture {
 protected:
  void SetUp() override {
    if (!has_terminals()) GTEST_SKIP() << "this system has no pseudo terminals: /dev/pts is not mounted";
  }
};

class PlayedTerminal {
 public:
  // Answers the question for the device attributes, and all that were asked before, so.
  struct Manner {
    std::string answer;  // empty: it never answers
    std::chrono::milliseconds delay{0};
    bool reads = true;  // it takes what is sent to it
  };

  PlayedTerminal(Manner manner, const winsize& size) : manner_(std::move(manner)) {
    near_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    EXPECT_EQ(grantpt(near_) + unlockpt(near_), 0);
    far_name_ = ptsname(near_);
    far_ = open(far_name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    EXPECT_GE(far_, 0);
    resize(size);
    before_ = settings();
    thread_ = std::thread([this] { play(); });
  }
  ~PlayedTerminal() {
    stop_ = true;
    thread_.join();
    close(near_), close(far_);
  }
  PlayedTerminal(const PlayedTerminal&) = delete;
  PlayedTerminal& operator=(const PlayedTerminal&) = delete;

  int file() const { return far_; }
  const std::string& name() const { return far_name_; }
  void resize(const winsize& size) const { ioctl(near_, TIOCSWINSZ, &size); }
  void type(const std::string& keys) const {
    EXPECT_EQ(::write(near_, keys.data(), keys.size()), ssize_t(keys.size()));
  }
  // Lets it read what is sent, if it did not.
  void read_on() { reads_ = true; }

  std::string shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
  }
  // Returns when this has been sent to it, or false after a long time.
  bool has_shown(const std::string& text) const {
    return eventually([&] { return shown().find(text) != std::string::npos; });
  }
  template <class Fn>
  static bool eventually(const Fn& fn) {
    for (int i = 0; i < 3000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
      if (fn()) return true;
    return false;
  }

  bool settings_are_restored() const {
    const termios now = settings();
    return now.c_iflag == before_.c_iflag && now.c_oflag == before_.c_oflag &&
           now.c_lflag == before_.c_lflag && std::memcmp(now.c_cc, before_.c_cc, sizeof now.c_cc) == 0;
  }
  // The bytes that the next program would read as typed keys.
  std::string typed_for_the_next() const {
    termios raw = settings();
    raw.c_lflag &= ~tcflag_t(ICANON | ECHO);
    raw.c_cc[VMIN] = 0, raw.c_cc[VTIME] = 0;
    tcsetattr(far_, TCSANOW, &raw);
    std::string bytes(4096, '\0');
    const ssize_t count = ::read(far_, bytes.data(), bytes.size());
    bytes.resize(size_t(std::max<ssize_t>(count, 0)));
    tcsetattr(far_, TCSANOW, &before_);
    return bytes;
  }

  // Runs the program with this terminal as its own, and as its input and error stream. Returns the process.
  pid_t start(const std::vector<std::string>& arguments,
              const std::vector<std::string>& variables = {}) const {
    std::vector<std::string> texts = {KAUSTIK_PROGRAM}, env = {"TERM=xterm-256color"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    env.insert(env.begin(), variables.begin(), variables.end());
    // Of the test's own environment only what a program with a sanitizer needs: another environment could
    // change what is shown.
    for (const char* name :
         {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "LSAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS"})
      if (const char* const value = std::getenv(name)) env.push_back(std::string(name) + '=' + value);
    const auto pointers = [](std::vector<std::string>& all) {
      std::vector<char*> list;
      for (std::string& text : all) list.push_back(text.data());
      list.push_back(nullptr);
      return list;
    };
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, far_name_.c_str(), O_RDWR, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, 0, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    pid_t pid = 0;
    EXPECT_EQ(posix_spawn(&pid, KAUSTIK_PROGRAM, &actions, &attributes, pointers(texts).data(),
                          pointers(env).data()),
              0);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return pid;
  }
  // The exit code, or -1 when a signal ended the process. What it has sent is shown then.
  int wait(pid_t pid) const {
    int status = 0;
    waitpid(pid, &status, 0);
    // On a busy machine bytes take their time from one side to the other, but they keep their order.
    const std::string end = "<end of the program>";
    EXPECT_EQ(::write(far_, end.data(), end.size()), ssize_t(end.size()));
    EXPECT_TRUE(has_shown(end));
    const std::lock_guard lock(mutex_);
    shown_.resize(std::min(shown_.size(), shown_.find(end)));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  termios settings() const {
    termios now{};
    EXPECT_EQ(tcgetattr(far_, &now), 0);
    return now;
  }

  void play() {
    reads_ = manner_.reads;
    size_t asked = 0;
    while (!stop_) {
      pollfd input{near_, POLLIN, 0};
      if (!reads_ || poll(&input, 1, 10) <= 0) {
        if (!reads_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        continue;
      }
      std::string bytes(1 << 16, '\0');
      const ssize_t count = ::read(near_, bytes.data(), bytes.size());
      if (count <= 0) continue;
      const std::lock_guard lock(mutex_);
      shown_.append(bytes, 0, size_t(count));
      const size_t at = shown_.find("\x1b[c", asked);
      if (at == std::string::npos || manner_.answer.empty()) continue;
      asked = at + 1;
      std::this_thread::sleep_for(manner_.delay);
      type(manner_.answer);
    }
  }

  const Manner manner_;
  int near_ = -1, far_ = -1;
  std::string far_name_;
  termios before_{};
  mutable std::mutex mutex_;
  mutable std::string shown_;
  std::atomic<bool> stop_ = false, reads_ = true;
  std::thread thread_;
};

inline const std::string kKittyAnswer = "\x1b_Gi=31;OK\x1b\\\x1b[6;20;10t\x1b[?62c";
inline const std::string kSixelAnswer = "\x1b[6;20;10t\x1b[?62;4;22c";
inline const std::string kPlainAnswer = "\x1b[?1;2c";

}  // namespace kaustik::test
