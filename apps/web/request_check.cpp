#include "apps/web/request_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <random>

namespace kaustik::app {

namespace {

// As browsers write the host of an address.
std::string in_url(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

// Compares without telling by its duration how many characters are right.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i) difference |= unsigned(static_cast<unsigned char>(a[i] ^ b[i]));
  return difference == 0;
}

// Whether the header Host names this machine itself. Other names may have been made to point here.
bool names_this_machine(const std::string& host, int port) {
  const std::array<std::string, 3> names = {"127.0.0.1", "localhost", "[::1]"};
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return host == fmt::format("{}:{}", name, port) || (port == 80 && host == name);
  });
}

}  // namespace

std::string PageAddress::url() const {
  return fmt::format("http://{}:{}/{}", in_url(host), port, token.empty() ? "" : token + "/");
}

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", uint32_t(random()));
  return token;
}

HttpResponse error_response(int status, const std::string& text) {
  return {status, "application/json", nlohmann::json{{"error", text}}.dump()};
}

std::optional<HttpResponse> refusal(HttpRequest* request, const PageAddress& address) {
  if (address.is_local() && !names_this_machine(request->host, address.port))
    return error_response(403, "this page answers to 127.0.0.1 and localhost only");
  const bool foreign = !request->origin.empty() && request->origin != "http://" + request->host;
  if (foreign || request->fetch_site == "cross-site" || request->fetch_site == "same-site")
    return error_response(403, "this page does not answer to pages of others");
  if (address.is_local()) return std::nullopt;
  const std::string& path = request->path;
  const size_t end = std::min(path.find('/', 1), path.size());
  if (path.empty() || !same_token(std::string_view(path).substr(1, end - 1), address.token))
    return error_response(403, "the address of this page has a token, which is wrong or missing here");
  request->path = path.substr(end);
  return std::nullopt;
}

}  // namespace kaustik::app
