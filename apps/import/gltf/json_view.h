#pragma once
// A glTF file's JSON, read with checks: what has the wrong type or leads out of a list is an error that names
// the place.

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

namespace kaustik::gltf {

using Json = nlohmann::json;

// What is wrong with the file: one sentence.
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A value and its name for messages: "materials[3].pbrMetallicRoughness".
class View {
 public:
  View() = default;
  View(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  bool exists() const { return json_ != nullptr; }
  explicit operator bool() const { return exists(); }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what) const;

  // A member of an object; one that does not exist when it is absent. An object is expected.
  View operator[](const char* name) const;
  bool has(const char* name) const { return (*this)[name].exists(); }
  // Of an object's members; none when absent.
  std::vector<std::string> names() const;
  // An item of a list; out of range is an error.
  View at(uint64_t i) const;
  // Of a list; 0 when absent.
  uint64_t size() const;

  // Of the values themselves; the fallback when absent.
  double number(double otherwise) const;
  double number() const;
  bool flag(bool otherwise) const;
  std::string text(const std::string& otherwise = {}) const;
  uint64_t count(uint64_t otherwise) const;  // whole, not negative
  uint64_t count() const;
  // `n` finite numbers.
  std::vector<double> numbers(size_t n, std::vector<double> otherwise) const;
  // An index into a list of `size` things.
  std::optional<uint64_t> index(uint64_t size) const;

 private:
  const Json* json_ = nullptr;
  std::string path_;
};

}  // namespace kaustik::gltf
