#pragma once
// The other end of sd_notify.

#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "server/hub/descriptor.hpp"

namespace genio::test {

/// A datagram socket at an abstract name of its own.
class ManagerSocket {
 public:
  ManagerSocket() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un any{};
    any.sun_family = AF_UNIX;
    // Without a name the system chooses one.
    if (bind(socket_.get(), reinterpret_cast<sockaddr*>(&any), sizeof any.sun_family) != 0)
      throw std::runtime_error("no socket");
    socklen_t length = sizeof any;
    getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&any), &length);
    address_ = std::string(any.sun_path, length - offsetof(sockaddr_un, sun_path));
    address_[0] = '@';
  }
  const std::string& address() const { return address_; }
  /// The next message, or nothing where none waits.
  std::string next() {
    std::array<char, 4096> bytes;
    const ssize_t got = recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    return got > 0 ? std::string(bytes.data(), size_t(got)) : "";
  }

 private:
  Descriptor socket_;
  std::string address_;
};

}  // namespace genio::test
