#pragma once
// Runs the program as a process of its own, so that a test can kill it.

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

namespace kaustik::test {

// Shares the test's streams. Kills the process at the end if it still runs.
class ChildProcess {
 public:
  explicit ChildProcess(const std::vector<std::string>& arguments) {
    std::vector<std::string> texts = {KAUSTIK_PROGRAM};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    if (posix_spawn(&pid_, KAUSTIK_PROGRAM, nullptr, nullptr, argv.data(), environ) != 0) pid_ = 0;
  }
  ~ChildProcess() {
    if (running()) kill(SIGKILL);
    if (pid_ > 0 && !ended_) waitpid(pid_, &status_, 0);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool running() {
    if (pid_ > 0 && !ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
    return pid_ > 0 && !ended_;
  }
  void kill(int signal) const {
    if (pid_ > 0) ::kill(pid_, signal);  // 0 would mean the test's own group
  }
  // Returns the exit code, or -1 when a signal ended the process.
  int wait() {
    if (pid_ > 0 && !ended_) waitpid(pid_, &status_, 0);
    ended_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  pid_t pid_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace kaustik::test
