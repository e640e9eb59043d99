// The HTTP server by means of cpp-httplib, in a library that programs load when they first serve a page.

#include <fmt/format.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "apps/web/http_server.h"
#include "core/thread_time.h"

namespace kaustik::app {

namespace {

// Each stream of events keeps a thread.
constexpr size_t kThreads = 48, kMostStreams = 32;
constexpr size_t kLongestBody = 1 << 16;  // of a request
constexpr time_t kLongestWait = 5;        // for a request, seconds

HttpRequest request_of(const httplib::Request& from) {
  HttpRequest request{from.method,
                      from.path,
                      from.body,
                      {},
                      from.get_header_value("Host"),
                      from.get_header_value("Origin"),
                      from.get_header_value("Sec-Fetch-Site"),
                      from.get_header_value("Sec-Fetch-Mode")};
  for (const auto& [name, value] : from.params) request.query.emplace(name, value);
  return request;
}

// The port of this machine at which a descriptor is connected, or 0 if it is no socket of a network.
int local_port(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return 0;
}

// Ends what this process receives at a port, so that no thread waits there for another request. The library
// does not tell its connections, hence the list of all descriptors; without one, threads wait their time.
void end_requests_at(int port) {
  using std::filesystem::directory_iterator;
  std::error_code error;
  for (auto entry = directory_iterator("/proc/self/fd", error); entry != directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (local_port(descriptor) == port) shutdown(descriptor, SHUT_RD);
  }
}

// What a thread answers at present.
struct Answer {
  double began = 0;  // in the thread's processor time, seconds
  std::function<void(double)> sent{};
};
thread_local Answer present;

class Server final : public HttpServer {
 public:
  explicit Server(HttpHandler& handler) : handler_(handler) {}
  ~Server() override {
    ending_ = true;
    server_.stop();
    if (port_ > 0) end_requests_at(port_);
    if (thread_.joinable()) thread_.join();
  }

  // Returns why it cannot serve, or an empty string.
  std::string start(const char* address, int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // Also how long a client may take from its connection to its first request, which on a busy machine is
    // more than a second.
    server_.set_keep_alive_timeout(kLongestWait);
    server_.set_read_timeout(kLongestWait);
    server_.set_payload_max_length(kLongestBody);
    // Not the library's default, by which two processes may share a port.
    server_.set_socket_options([](auto socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    const auto answer = [this](const httplib::Request& from, httplib::Response& to) {
      this->answer(from, to);
    };
    // Called by the thread of the answer when it has been sent.
    server_.set_logger([](const httplib::Request&, const httplib::Response&) {
      if (present.sent) present.sent(thread_seconds() - present.began);
      present.sent = nullptr;
    });
    server_.Get(".*", answer);
    server_.Post(".*", answer);
    port_ = port > 0 ? (server_.bind_to_port(address, port) ? port : -1) : server_.bind_to_any_port(address);
    if (port_ <= 0)
      return port > 0 ? fmt::format("cannot serve a page at port {} of {}: it is taken or not allowed", port,
                                    address)
                      : fmt::format(
                            "cannot serve a page at {}: no port is free, or it is no address of this machine",
                            address);
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      ended_ = true;
    });
    // Before it runs, stop() would do nothing, and the thread would listen for ever.
    while (!server_.is_running() && !ended_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  }
  int port() const override { return port_; }

 private:
  void answer(const httplib::Request& from, httplib::Response& to) {
    present.began = thread_seconds();
    HttpResponse response = handler_.answer(request_of(from));
    present.sent = std::move(response.sent);
    to.status = response.status;
    for (const auto& [name, value] : response.headers) to.set_header(name.c_str(), value);
    if (response.events)
      send_events(to);
    else if (!response.body.empty()) {
      to.set_header("Content-Type", response.type.c_str());
      to.body = std::move(response.body);  // set_content() would copy it
    }
  }

  void send_events(httplib::Response& to) {
    if (++streams_ > kMostStreams) {
      --streams_;
      to.status = 503;
      return;
    }
    handler_.stream_begins();
    to.set_chunked_content_provider(
        "text/event-stream",
        [this, reader = std::make_shared<EventReader>()](size_t, httplib::DataSink& sink) {
          const std::string text = ending_ ? std::string() : handler_.next_event(reader.get());
          if (!text.empty()) return sink.write(text.data(), text.size());
          sink.done();
          return true;
        },
        [this](bool) {
          --streams_;
          handler_.stream_ends();
        });
  }

  HttpHandler& handler_;
  httplib::Server server_;
  std::thread thread_;
  std::atomic<bool> ending_{false}, ended_{false};
  std::atomic<size_t> streams_{0};
  int port_ = 0;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) HttpServer* kaustik_start_http_server(const char* address,
                                                                                        int port,
                                                                                        HttpHandler& handler,
                                                                                        std::string& error) {
  try {
    auto server = std::make_unique<Server>(handler);
    error = server->start(address, port);
    return error.empty() ? server.release() : nullptr;
  } catch (const std::exception& problem) {
    error = problem.what();
    return nullptr;
  }
}

}  // namespace kaustik::app
