#pragma once
// Names for the things of formats in which several may have the same name.

#include <map>
#include <set>
#include <string>

namespace kaustik {

class UniqueNames {
 public:
  // The name, or if it was taken before, the name with a number: `wall`, `wall 2`, `wall 3`. `unnamed` stands
  // for an empty one.
  std::string take(const std::string& asked) {
    const std::string name = asked.empty() ? "unnamed" : asked;
    std::string own = name;
    for (int& count = counts_[name]; !taken_.insert(own).second;) {
      count = count == 0 ? 2 : count + 1;
      own = name + " " + std::to_string(count);
    }
    return own;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> counts_;  // the last number that was given, by name
};

}  // namespace kaustik
