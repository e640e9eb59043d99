#pragma once
// Writes several files such that one that cannot be written does not cost the others.

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "apps/console/console.h"

namespace kaustik::app {

class FileWriter {
 public:
  explicit FileWriter(const Console& console) : console_(console) {}

  // Calls save(), which writes the file `path` or throws a std::exception whose text names it.
  template <class Save>
  void write(const std::string& path, const Save& save) {
    try {
      save();
      written_.push_back(path);
    } catch (const std::bad_alloc&) {
      failures_.push_back(path + ": out of memory");
    } catch (const std::exception& error) {
      failures_.emplace_back(error.what());
    }
  }

  // Logs the files that were written, and prints an error for each of the others. False if there is any.
  bool report() const {
    for (const std::string& path : written_) console_.note("wrote " + path);
    for (const std::string& failure : failures_) console_.error(failure);
    return failures_.empty();
  }

 private:
  const Console& console_;
  std::vector<std::string> written_, failures_;
};

}  // namespace kaustik::app
