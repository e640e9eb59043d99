#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace kaustik::app {

// JSON in one line. Bytes that are no UTF-8, as names of files may hold, are replaced.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace kaustik::app
