// start_http_server(): loads the module of cpp-httplib.

#include <stdexcept>

#include "apps/web/http_server.h"
#include "core/files/module_entry.h"

namespace kaustik::app {

std::unique_ptr<HttpServer> start_http_server(const std::string& address, int port, HttpHandler& handler) {
  const auto start = module_entry<HttpServer*(const char*, int, HttpHandler&, std::string&)>(
      KAUSTIK_HTTP_MODULE, "kaustik_start_http_server", "which serves pages");
  std::string error;
  std::unique_ptr<HttpServer> server(start(address.c_str(), port, handler, error));
  if (!server) throw std::runtime_error(error);
  return server;
}

}  // namespace kaustik::app
