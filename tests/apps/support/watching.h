#pragma once
// Observes a command while it runs: the signals that it handles, the threads that it creates.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

namespace kaustik::test {

// Returns once the command handles this signal, or when `stop` says that it has ended.
inline void wait_until_handled(int signal, const std::atomic<bool>& stop) {
  struct sigaction current {};
  while (!stop && sigaction(signal, nullptr, &current) == 0 && current.sa_handler == SIG_DFL) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

inline int thread_count() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Threads:")) return std::stoi(line.substr(8));
  }
  return 0;
}

struct ThreadCounts {
  int before = 0;  // the caller, the watcher, and workers of earlier tests
  int most = 0;    // largest number while the work ran
};

inline ThreadCounts count_threads(const std::function<void()>& work) {
  std::atomic<bool> stop = false;
  std::atomic<int> most = 0;
  std::thread watcher([&] {
    while (!stop) {
      most = std::max(most.load(), thread_count());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const int before = thread_count();
  work();
  stop = true;
  watcher.join();
  return {before, most};
}

}  // namespace kaustik::test
