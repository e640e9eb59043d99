#include "apps/web/request_check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <random>

#include "apps/web/json_text.h"

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

// An address for people in place of one that means all addresses of the machine.
std::string reachable(const std::string& host) {
  char name[256] = {};
  if (host != "0.0.0.0" && host != "::") return host;
  return gethostname(name, sizeof(name) - 1) == 0 && name[0] != '\0' ? name : host;
}

// Whether the header Host names this machine itself, at any port, as tunnels have their own. Other names may
// have been made to point here.
bool names_this_machine(const std::string& host) {
  constexpr std::array<std::string_view, 3> kNames = {"127.0.0.1", "localhost", "[::1]"};
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
    return host.starts_with(name) && (host.size() == name.size() || host[name.size()] == ':') &&
           host.find_first_not_of("0123456789", name.size() + 1) == std::string::npos;
  });
}

// Whether a page of another origin sends the request. A link that opens this page is no such request.
bool is_foreign(const HttpRequest& request, bool opens_page) {
  if (!request.origin.empty() && request.origin != "http://" + request.host) return true;
  const bool cross = request.fetch_site == "cross-site" || request.fetch_site == "same-site";
  return cross && !(opens_page && request.method == "GET" && request.fetch_mode == "navigate");
}

}  // namespace

std::string PageAddress::url() const {
  return fmt::format("http://{}:{}/{}", in_url(reachable(host)), port, token.empty() ? "" : token + "/");
}

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", uint32_t(random()));
  return token;
}

HttpResponse error_response(int status, const std::string& text) {
  return {status, "application/json", json_text({{"error", text}})};
}

std::optional<HttpResponse> refusal(HttpRequest* request, const PageAddress& address) {
  std::string& path = request->path;
  if (address.is_local()) {
    if (!names_this_machine(request->host))
      return error_response(403, "this page answers to 127.0.0.1 and localhost only");
  } else {
    const size_t end = std::min(path.find('/', 1), path.size());
    if (!path.starts_with('/') || !same_token(std::string_view(path).substr(1, end - 1), address.token))
      return error_response(403, "the address of this page has a token, which is wrong or missing here");
    // The page's own requests are relative to this folder.
    if (end == path.size()) return HttpResponse{308, "", "", {{"Location", path + "/"}}};
    path = path.substr(end);
  }
  if (is_foreign(*request, path == "/"))
    return error_response(403, "this page does not answer to pages of others");
  return std::nullopt;
}

}  // namespace kaustik::app
