#pragma once
// What memory the process has, as the kernel counts it (proc(5)).

#include <cstdint>
#include <string>
#include <string_view>

namespace kaustik {

// Bytes by /proc/self/statm: of the address space, what of it is resident, what of that are pages of files,
// and data with stacks. All 0 if they cannot be read.
struct ProcessMemory {
  uint64_t mapped = 0, resident = 0, of_files = 0, data = 0;
};
// `root`: a prefix of /proc, for tests.
ProcessMemory process_memory(const std::string& root = "");

// Bytes of memory that belong to the process alone: without pages of files, which the system can drop.
uint64_t held_memory(const std::string& root = "");

// A size that /proc/self/status names, such as "VmHWM:", in bytes; 0 if it cannot be read.
uint64_t status_bytes(std::string_view name);

}  // namespace kaustik
