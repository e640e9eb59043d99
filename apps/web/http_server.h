#pragma once
// Interface to cpp-httplib, which answers the requests of the live page. It is an interface because that
// library brings others for encryption and compression, whose loading would slow every run down: programs
// load it when they first serve a page.

#include <charconv>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kaustik::app {

struct HttpRequest {
  std::string method, path, body;
  std::map<std::string, std::string> query;
  // The headers Host, Origin, Sec-Fetch-Site and Sec-Fetch-Mode; empty without them.
  std::string host, origin, fetch_site, fetch_mode{};

  // A value of the query, or `otherwise`.
  std::string value(const std::string& name, const std::string& otherwise = {}) const {
    const auto found = query.find(name);
    return found == query.end() ? otherwise : found->second;
  }
  // A value that is a whole number, and nothing for other texts.
  std::optional<uint64_t> number(const std::string& name) const {
    const std::string text = value(name);
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole ? std::optional(number) : std::nullopt;
  }
};

struct HttpResponse {
  int status = 200;
  std::string type, body;  // the type of the body
  std::vector<std::pair<std::string, std::string>> headers{};
  bool events = false;  // the body follows as server-sent events, by HttpHandler::next_event()
  // Told the processor time of the answer in seconds, once it is sent. May be empty.
  std::function<void(double)> sent{};
};

// What one connection for events has been told so far.
struct EventReader {
  uint64_t seen = 0;
};

// Called by many threads at once. Must not throw.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  virtual HttpResponse answer(const HttpRequest& request) = 0;
  // The next piece of a stream of events, for which it may wait for a second. Empty: the stream ends.
  virtual std::string next_event(EventReader* reader) = 0;
  // A stream of events begins, or ends.
  virtual void stream_begins() = 0;
  virtual void stream_ends() = 0;
};

// Serves until it is destroyed, which takes up to about a second.
class HttpServer {
 public:
  virtual ~HttpServer() = default;
  virtual int port() const = 0;
};

// address: of this machine, by number. port: 0 = any that is free. handler must outlive the server. Throws
// std::runtime_error if the port is taken or if the library cannot be loaded.
std::unique_ptr<HttpServer> start_http_server(const std::string& address, int port, HttpHandler& handler);

}  // namespace kaustik::app
