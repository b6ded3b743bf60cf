#pragma once
// A client of the metrics endpoint that may send anything.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <string>
#include <string_view>

#include "server/hub/descriptor.hpp"

namespace genio::test {

class HttpClient {
 public:
  explicit HttpClient(uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET, to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  }
  bool connected() const { return connected_; }
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(size_t(sent));
    }
    return true;
  }
  /// All that comes until the other side closes, at most for so long without a byte.
  std::string receive(int patience_ms = 20000) {
    std::string all;
    std::array<char, 16384> bytes;
    pollfd polled{socket_.get(), POLLIN, 0};
    while (poll(&polled, 1, patience_ms) > 0) {
      const ssize_t got = recv(socket_.get(), bytes.data(), bytes.size(), 0);
      if (got <= 0) return all;
      all.append(bytes.data(), size_t(got));
    }
    return all + "(and no end)";
  }

 private:
  Descriptor socket_;
  bool connected_ = false;
};

inline std::string http_get(uint16_t port, const std::string& path = "/metrics") {
  HttpClient client(port);
  client.send("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
  return client.receive();
}

}  // namespace genio::test
