#include "apps/import/gltf/file/json_view.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace kaustik::gltf {

void View::fail(const std::string& what) const {
  throw FormatError(fmt::format("`{}` {}", path_, what));
}

View View::operator[](const char* name) const {
  if (!json_) return {};
  if (!json_->is_object()) fail("must be an object");
  const auto found = json_->find(name);
  const std::string path = path_.empty() ? name : fmt::format("{}.{}", path_, name);
  if (found == json_->end()) {
    View missing;
    missing.path_ = path;
    return missing;
  }
  return {*found, path};
}

std::vector<std::string> View::names() const {
  std::vector<std::string> out;
  if (json_ && json_->is_object()) {
    for (const auto& member : json_->items()) out.push_back(member.key());
  }
  return out;
}

bool View::is_list() const {
  return json_ && json_->is_array();
}

View View::at(uint64_t i) const {
  if (i >= size()) fail(fmt::format("has no item {}: there are {}", i, size()));
  return {(*json_)[i], fmt::format("{}[{}]", path_, i)};
}

uint64_t View::size() const {
  if (!json_) return 0;
  if (!json_->is_array()) fail("must be a list");
  return json_->size();
}

double View::number(double otherwise) const {
  return json_ ? number() : otherwise;
}

double View::number() const {
  if (!json_ || !json_->is_number()) fail("must be a number");
  const double value = json_->get<double>();
  if (!(std::abs(value) <= double(std::numeric_limits<float>::max()))) fail("is beyond the range of floats");
  return value;
}

bool View::flag(bool otherwise) const {
  if (!json_) return otherwise;
  if (!json_->is_boolean()) fail("must be true or false");
  return json_->get<bool>();
}

std::string View::text(const std::string& otherwise) const {
  if (!json_) return otherwise;
  if (!json_->is_string()) fail("must be a string");
  return json_->get<std::string>();
}

uint64_t View::count(uint64_t otherwise) const {
  return json_ ? count() : otherwise;
}

uint64_t View::count() const {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (!json_ || !json_->is_number()) fail("must be a non-negative integer");
  const double value = json_->get<double>();
  if (!(value >= 0 && value <= kExact && value == std::floor(value)))
    fail(fmt::format("must be a non-negative integer, not {}", value));
  return static_cast<uint64_t>(value);
}

std::vector<double> View::numbers(size_t n, std::vector<double> otherwise) const {
  if (!json_) return otherwise;
  if (size() != n) fail(fmt::format("must be {} numbers, not {}", n, size()));
  std::vector<double> out;
  for (size_t i = 0; i < n; ++i) out.push_back(at(i).number());
  return out;
}

std::optional<uint64_t> View::index(uint64_t size) const {
  if (!json_) return std::nullopt;
  const uint64_t i = count();
  if (i >= size) fail(fmt::format("is {}: there are {}", i, size));
  return i;
}

}  // namespace kaustik::gltf
