// start_http_server(): loads the module, which lies where images/loaded.cpp finds that of the images.

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "apps/web/http_server.h"

namespace kaustik::app {

std::unique_ptr<HttpServer> start_http_server(const std::string& address, int port, HttpHandler& handler) {
  using Start = HttpServer* (*)(const char*, int, HttpHandler&, std::string&);
  const auto fail = [] {
    return std::runtime_error(
        fmt::format("cannot load {}, which serves pages: {}", KAUSTIK_HTTP_MODULE, dlerror()));
  };
  // Never closed: threads of the server may still return through its code.
  void* const library = dlopen(KAUSTIK_HTTP_MODULE, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw fail();
  void* const entry = dlsym(library, "kaustik_start_http_server");
  if (!entry) throw fail();
  std::string error;
  HttpServer* const server = reinterpret_cast<Start>(entry)(address.c_str(), port, handler, error);
  if (!server) throw std::runtime_error(error);
  return std::unique_ptr<HttpServer>(server);
}

}  // namespace kaustik::app
