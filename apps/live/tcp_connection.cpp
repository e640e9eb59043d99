#include "apps/live/tcp_connection.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "core/stopwatch.h"

namespace kaustik::app {

namespace {

constexpr std::chrono::milliseconds kPollTime{20};
constexpr double kConnectSeconds = 2;

// What a host's name stands for, or why it stands for nothing.
struct Resolved {
  std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses{nullptr, freeaddrinfo};
  std::string trouble;
};

Resolved resolve(const std::string& host, uint16_t port, int family, int flags) {
  addrinfo hints{};
  hints.ai_family = family;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  Resolved resolved;
  if (error == 0)
    resolved.addresses.reset(found);
  else
    resolved.trouble = error == EAI_SYSTEM ? std::strerror(errno) : gai_strerror(error);
  return resolved;
}

// A name may take many seconds, and the system cannot be told to stop: a thread asks for it, which is left
// alone if the caller gives up.
Resolved resolve(const ServerAddress& address, const KeepWaiting& keep_waiting) {
  Resolved resolved = resolve(address.host, address.port, AF_UNSPEC, AI_NUMERICHOST);
  if (resolved.addresses) return resolved;
  std::packaged_task<Resolved()> task(
      [address] { return resolve(address.host, address.port, AF_UNSPEC, 0); });
  std::future<Resolved> result = task.get_future();
  try {
    std::thread(std::move(task)).detach();
  } catch (const std::system_error& error) {
    resolved.trouble = error.what();
    return resolved;
  }
  while (result.wait_for(kPollTime) != std::future_status::ready)
    if (!keep_waiting()) {
      resolved.trouble = "its address is not known yet";
      return resolved;
    }
  return result.get();
}

// Returns 0 once the socket can be written to or is lost, or the error that the wait ended with.
int wait_writable(int socket, const KeepWaiting& keep_waiting) {
  while (keep_waiting()) {
    pollfd entry{socket, POLLOUT, 0};
    const int ready = poll(&entry, 1, int(kPollTime.count()));
    if (ready > 0) return 0;
    if (ready < 0 && errno != EINTR) return errno;
  }
  return ETIMEDOUT;
}

// A socket that asks for a port of its own machine on which nobody listens may be given the same port, and is
// then connected to itself.
bool is_connected_to_itself(int socket) {
  sockaddr_storage own{}, other{};
  socklen_t own_size = sizeof own, other_size = sizeof other;
  return getsockname(socket, reinterpret_cast<sockaddr*>(&own), &own_size) == 0 &&
         getpeername(socket, reinterpret_cast<sockaddr*>(&other), &other_size) == 0 &&
         own_size == other_size && std::memcmp(&own, &other, own_size) == 0;
}

// Returns 0, or the error number.
int connect_socket(int socket, const addrinfo& to, const KeepWaiting& keep_waiting) {
  if (connect(socket, to.ai_addr, to.ai_addrlen) != 0) {
    if (errno != EINPROGRESS && errno != EINTR) return errno;
    const Stopwatch watch;
    const auto in_time = [&] { return watch.seconds() < kConnectSeconds && keep_waiting(); };
    if (const int error = wait_writable(socket, in_time)) return error;
    int error = 0;
    socklen_t size = sizeof error;
    if (getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) != 0) return errno;
    if (error != 0) return error;
  }
  return is_connected_to_itself(socket) ? ECONNREFUSED : 0;
}

[[noreturn]] void refuse_address(std::string_view text, std::string_view what) {
  throw std::invalid_argument(fmt::format(
      "`{}`: {}; expected HOST or HOST:PORT, like localhost, 192.0.2.7:14158 or [2001:db8::7]:14158", text,
      what));
}

uint16_t parse_port(std::string_view text, std::string_view port) {
  uint16_t number = 0;
  const char* const end = port.data() + port.size();
  const auto [stop, error] = std::from_chars(port.data(), end, number);
  if (error != std::errc() || stop != end || number == 0)
    refuse_address(text, fmt::format("`{}` is not a port, a whole number from 1 to 65535", port));
  return number;
}

// The host of an address, and its port with the colon before it, if there is one.
std::pair<std::string_view, std::string_view> split_address(std::string_view text) {
  if (!text.starts_with('[')) {
    const size_t colon = std::min(text.find(':'), text.size());
    const std::string_view port = text.substr(colon);
    if (port.rfind(':') != 0 && !port.empty())
      refuse_address(text, "it has more than one colon, and an IPv6 address stands in brackets");
    return {text.substr(0, colon), port};
  }
  const size_t bracket = text.find(']');
  if (bracket == std::string_view::npos) refuse_address(text, "the closing bracket is missing");
  const std::string_view port = text.substr(bracket + 1);
  if (!port.empty() && port[0] != ':') refuse_address(text, "a colon and the port follow the bracket");
  const std::string_view host = text.substr(1, bracket - 1);
  if (!resolve(std::string(host), 1, AF_INET6, AI_NUMERICHOST).addresses)
    refuse_address(text, fmt::format("`{}` is not an IPv6 address", host));
  return {host, port};
}

}  // namespace

std::string ServerAddress::text() const {
  const bool brackets = host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", brackets ? "[" : "", host, brackets ? "]" : "", port);
}

ServerAddress parse_address(std::string_view text, uint16_t default_port) {
  const auto [host, port] = split_address(text);
  if (host.empty()) refuse_address(text, "the host is missing");
  if (host.find_first_of(" \t\r\n/@[]") != std::string_view::npos)
    refuse_address(text, fmt::format("`{}` is not the name of a host", host));
  return {std::string(host), port.empty() ? default_port : parse_port(text, port.substr(1))};
}

void TcpConnection::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void TcpConnection::lose(int error) {
  close();
  trouble_ = error == 0 ? "it has closed the connection" : std::strerror(error);
}

bool TcpConnection::open(const ServerAddress& address, const KeepWaiting& keep_waiting) {
  close();
  const Resolved resolved = resolve(address, keep_waiting);
  trouble_ = resolved.trouble;
  for (const addrinfo* to = resolved.addresses.get(); to; to = to->ai_next) {
    socket_ = socket(to->ai_family, to->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, to->ai_protocol);
    const int error = socket_ < 0 ? errno : connect_socket(socket_, *to, keep_waiting);
    if (error == 0) return true;
    lose(error);
  }
  return false;
}

bool TcpConnection::check() {
  char ignored[4096];
  constexpr int kMostReads = 64;  // of a server that does not stop
  for (int i = 0; is_open() && i < kMostReads; ++i) {
    const ssize_t count = recv(socket_, ignored, sizeof ignored, MSG_DONTWAIT);
    if (count > 0 || (count < 0 && errno == EINTR)) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return true;
    lose(count == 0 ? 0 : errno);
  }
  return is_open();
}

bool TcpConnection::send(std::string_view bytes, const KeepWaiting& keep_waiting) {
  while (is_open() && !bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count >= 0) {
      bytes.remove_prefix(size_t(count));
      if (!keep_waiting()) break;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      const int error = wait_writable(socket_, keep_waiting);
      if (error == ETIMEDOUT) return false;
      if (error != 0) lose(error);
    } else if (errno != EINTR) {
      lose(errno);
    }
  }
  return is_open() && bytes.empty();
}

}  // namespace kaustik::app
