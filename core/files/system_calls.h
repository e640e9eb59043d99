#pragma once
// The system calls by which kaustik opens, writes and replaces files. This is the one place where tests make
// them fail.

#include <sys/types.h>

#include <cstddef>

namespace kaustik {

enum class SystemCall { kOpen, kRead, kWrite, kSync, kClose, kLink, kRename, kMap };

// Is asked before each call. Returns 0 if the call is to be made, or else the errno with which it fails.
using SystemFault = int (*)(SystemCall);

// Sets the fault of the process; null: none. For tests.
void set_system_fault(SystemFault fault);

// Each returns what the system call of its name returns, and sets errno; those that a signal interrupts are
// made again. A file that is opened is closed in child processes.
int open_file(const char* path, int flags, mode_t mode = 0666);
// Fails if any part of the path is a symbolic link. A kernel older than Linux 5.6 looks at the last part
// alone.
int open_without_links(const char* path, int flags);
ssize_t read_some(int file, void* bytes, size_t size);
ssize_t write_some(int file, const void* bytes, size_t size);
int sync_file(int file);
int close_file(int file);
// Gives an open file without a name (O_TMPFILE) this name, which must be new.
int name_file(int file, const char* path);
int rename_file(const char* from, const char* to);
// The whole file, to be read only; MAP_FAILED on failure.
void* map_file(int file, size_t size);

}  // namespace kaustik
