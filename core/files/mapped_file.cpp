#include "core/files/mapped_file.h"

#include <sys/mman.h>

#include <cerrno>

#include "core/files/input_file.h"
#include "core/files/system_calls.h"

namespace kaustik {

MappedFile::MappedFile(const std::string& path) {
  const InputFile file(path);
  if (file.size() == 0) return;
  void* const data = map_file(file.descriptor(), file.size());
  if (data == MAP_FAILED) throw_file_error(errno);
  bytes_ = {static_cast<const std::byte*>(data), file.size()};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace kaustik
