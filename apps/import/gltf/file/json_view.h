#pragma once
// Checked access to a glTF file's JSON: a value of the wrong type or an index out of range throws a
// FormatError that names the place.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace kaustik::gltf {

using Json = nlohmann::json;

// A damaged or unsupported file; what() is one sentence.
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A JSON value and its path for messages, such as "materials[3].pbrMetallicRoughness". A View of an absent
// value exists, but exists() is false.
class View {
 public:
  View() = default;
  View(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  bool exists() const { return json_ != nullptr; }
  explicit operator bool() const { return exists(); }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what) const;

  // A member of an object; a View of nothing when it is absent. Throws if this is not an object.
  View operator[](const char* name) const;
  bool has(const char* name) const { return (*this)[name].exists(); }
  bool is_list() const;
  // The names of an object's members; empty when the object is absent.
  std::vector<std::string> names() const;
  // An item of a list; throws when i is out of range.
  View at(uint64_t i) const;
  // The size of a list; 0 when it is absent.
  uint64_t size() const;

  // The value itself; `otherwise` when it is absent. The forms without a default throw then.
  double number(double otherwise) const;
  double number() const;
  bool flag(bool otherwise) const;
  std::string text(const std::string& otherwise = {}) const;
  uint64_t count(uint64_t otherwise) const;  // a non-negative integer
  uint64_t count() const;
  // A list of `n` finite numbers; `otherwise` when it is absent.
  std::vector<double> numbers(size_t n, std::vector<double> otherwise) const;
  // An index below `size`; nothing when it is absent.
  std::optional<uint64_t> index(uint64_t size) const;

 private:
  const Json* json_ = nullptr;
  std::string path_;
};

}  // namespace kaustik::gltf
