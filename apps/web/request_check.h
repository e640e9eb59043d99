#pragma once
// Which requests a page answers. A program that serves on this machine can be reached by any page that a
// browser shows: by its address, and under any name that someone lets point to 127.0.0.1 ("DNS rebinding").

#include <optional>
#include <string>

#include "apps/web/http_server.h"

namespace kaustik::app {

// Where a page can be reached.
struct PageAddress {
  std::string host = "127.0.0.1";  // a number
  int port = 0;
  // Part of the page's path, for pages that other machines may reach; empty: only this machine can, without
  // one.
  std::string token{};

  bool is_local() const { return token.empty(); }
  std::string url() const;
};

// 128 random bits as text.
std::string random_token();

// An error for a request that does not come from the page itself or from a program: one for another host, one
// from the page of another origin, or one without the token; a redirection where only the last slash of the
// page's address is missing. Otherwise nothing, and request.path then begins behind the token: "/pixels".
std::optional<HttpResponse> refusal(HttpRequest* request, const PageAddress& address);

HttpResponse error_response(int status, const std::string& text);

}  // namespace kaustik::app
