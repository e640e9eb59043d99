#pragma once
// Texts of users and of files of other programs.

#include <filesystem>
#include <string>
#include <string_view>

namespace kaustik {

// ASCII letters in lower case, whatever the locale.
inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// The extension of a file name in lower case, with its dot; empty if it has none.
inline std::string lower_extension(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace kaustik
