// Requests to the live page. An input is one: a line each for method, path, query, Host, Origin,
// Sec-Fetch-Site and Sec-Fetch-Mode.

#include "apps/web/request_check.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

namespace {

app::HttpRequest request_of(std::string_view text) {
  const auto line = [&] {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string out(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return out;
  };
  app::HttpRequest request;
  request.method = line(), request.path = line();
  request.query.emplace("x", line());
  request.host = line(), request.origin = line();
  request.fetch_site = line(), request.fetch_mode = line();
  return request;
}

// Whether a host is this machine by one of its three names, at any port; written apart from the code that is
// tested.
bool is_here(std::string host) {
  while (!host.empty() && host.back() >= '0' && host.back() <= '9' && host.find(':') != std::string::npos &&
         host != "[::1")
    host.pop_back();
  if (host.ends_with(':')) host.pop_back();
  return host == "127.0.0." || host == "127.0.0.1" || host == "localhost" || host == "[::1]";
}

}  // namespace

void fuzz_http(Bytes input) {
  const app::HttpRequest asked = request_of(as_text(input));
  asked.number("x");
  app::HttpRequest local = asked;
  if (!app::refusal(&local, {"127.0.0.1", 4711})) {
    if (!is_here(asked.host)) throw Violation("a request for another host is answered");
    if (!asked.origin.empty() && asked.origin != "http://" + asked.host)
      throw Violation("the page of another origin is answered");
  }
  const std::string token = "0123456789abcdef0123456789abcdef";
  app::HttpRequest remote = asked;
  if (const auto refused = app::refusal(&remote, {"192.168.1.5", 4711, token}); !refused) {
    if (!asked.path.starts_with("/" + token + "/"))
      throw Violation("a request without the token is answered");
    if (asked.path != "/" + token + remote.path) throw Violation("the token is not cut off");
  } else {
    app::error_response(refused->status, asked.path);
  }
}

}  // namespace kaustik::fuzz
