// Each function asks for a fault, then makes the system call.

#include "core/files/system_calls.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>

// Since Linux 5.6, and of older headers in none.
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#endif

namespace kaustik {

namespace {

std::atomic<SystemFault> current_fault = nullptr;

// Whether the call is to fail; errno is then set.
bool fails(SystemCall call) {
  const SystemFault fault = current_fault;
  const int error = fault ? fault(call) : 0;
  if (error != 0) errno = error;
  return error != 0;
}

// Makes a call again while signals interrupt it.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

void set_system_fault(SystemFault fault) {
  current_fault = fault;
}

int open_file(const char* path, int flags, mode_t mode) {
  if (fails(SystemCall::kOpen)) return -1;
  return uninterrupted([&] { return ::open(path, flags | O_CLOEXEC, mode); });
}

int open_without_links(const char* path, int flags) {
  if (fails(SystemCall::kOpen)) return -1;
#ifdef RESOLVE_NO_SYMLINKS
  open_how how{};
  how.flags = static_cast<uint64_t>(flags | O_CLOEXEC);
  how.resolve = RESOLVE_NO_SYMLINKS;
  const int file = static_cast<int>(
      uninterrupted([&] { return ::syscall(SYS_openat2, AT_FDCWD, path, &how, sizeof how); }));
  // Filters of system calls in containers answer EPERM to those that they do not know.
  if (file >= 0 || (errno != ENOSYS && errno != EPERM)) return file;
#endif
  return uninterrupted([&] { return ::open(path, flags | O_CLOEXEC | O_NOFOLLOW); });
}

ssize_t read_some(int file, void* bytes, size_t size) {
  if (fails(SystemCall::kRead)) return -1;
  return uninterrupted([&] { return ::read(file, bytes, size); });
}

ssize_t write_some(int file, const void* bytes, size_t size) {
  if (fails(SystemCall::kWrite)) return -1;
  return uninterrupted([&] { return ::write(file, bytes, size); });
}

int sync_file(int file) {
  if (fails(SystemCall::kSync)) return -1;
  return uninterrupted([&] { return ::fsync(file); });
}

int close_file(int file) {
  const bool failed = fails(SystemCall::kClose);
  const int error = errno;
  // Linux has closed the file even if a signal interrupted the call: another call might close another file.
  const int result = ::close(file) != 0 && errno != EINTR ? -1 : 0;
  if (failed) errno = error;
  return failed ? -1 : result;
}

int name_file(int file, const char* path) {
  if (fails(SystemCall::kLink)) return -1;
  const std::string open = "/proc/self/fd/" + std::to_string(file);
  return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW);
}

int rename_file(const char* from, const char* to) {
  return fails(SystemCall::kRename) ? -1 : std::rename(from, to);
}

void* map_file(int file, size_t size) {
  return fails(SystemCall::kMap) ? MAP_FAILED : ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file, 0);
}

}  // namespace kaustik
