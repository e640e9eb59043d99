#pragma once
// A stand-in for a full disk.

#include <sys/resource.h>

#include <csignal>

namespace kaustik::test {

// While it exists, no file of the process or of its children grows beyond so many bytes: writing more fails
// with EFBIG, "File too large".
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limit{bytes, previous_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, handled);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  // Not SIG_IGN, which child processes would inherit.
  static void handled(int /*signal*/) {}

  rlimit previous_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace kaustik::test
