#pragma once
// One HTTP request over a socket, byte by byte as the test writes it.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace kaustik::test {

struct HttpAnswer {
  int status = 0;
  std::string head, body;
};

// A connection to a port of this machine, closed at the end.
class HttpConnection {
 public:
  explicit HttpConnection(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(uint16_t(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0;
  }
  ~HttpConnection() { close(socket_); }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  bool connected() const { return connected_; }
  bool send(const std::string& text) const {
    return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == ssize_t(text.size());
  }
  // What has arrived next; empty at the end.
  std::string receive() const {
    char bytes[4096];
    const ssize_t count = recv(socket_, bytes, sizeof(bytes), 0);
    return count > 0 ? std::string(bytes, size_t(count)) : std::string();
  }

 private:
  int socket_;
  bool connected_ = false;
};

inline HttpAnswer http(int port, const std::string& method, const std::string& path,
                       const std::string& headers = {}, const std::string& body = {}) {
  const HttpConnection connection(port);
  const std::string host = headers.find("Host:") == std::string::npos
                               ? "Host: 127.0.0.1:" + std::to_string(port) + "\r\n"
                               : std::string();
  connection.send(method + " " + path + " HTTP/1.1\r\n" + host + headers +
                  "Connection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  std::string all;
  for (std::string some = connection.receive(); !some.empty(); some = connection.receive()) all += some;
  const size_t end = all.find("\r\n\r\n");
  if (end == std::string::npos || all.size() < 12) return {};
  return {std::stoi(all.substr(9, 3)), all.substr(0, end), all.substr(end + 4)};
}

}  // namespace kaustik::test
