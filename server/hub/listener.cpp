#include "server/hub/listener.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "forward/base/types.hpp"

namespace genio {
namespace {

constexpr int most_failures = 64;  // of connections that are gone when they are accepted

[[noreturn]] void refuse_port(uint16_t port) {
  const int error = errno;
  throw InputError("port " + std::to_string(port) + " of 127.0.0.1: " + std::strerror(error) +
                   (error == EADDRINUSE ? "; is a server running there already?" : ""));
}

void set_option(int socket, int level, int option, int value) {
  setsockopt(socket, level, option, &value, sizeof value);
}

/// Errors of accept that concern the connection that was to be accepted, which is gone.
bool concerns_one(int error) {
  return error == EINTR || error == ECONNABORTED || error == EPROTO || error == EPERM ||
         error == ETIMEDOUT || error == ENETDOWN || error == EHOSTUNREACH || error == ENETUNREACH;
}

/// Without descriptors accept fails also when nobody is there. False only when that is sure.
bool somebody_waits(int socket) {
  pollfd polled{socket, POLLIN, 0};
  return poll(&polled, 1, 0) != 0;
}

}  // namespace

HubListener::HubListener(uint16_t port)
    : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  if (!socket_) refuse_port(port);
  const int fd = socket_.get();
  // A server that was just stopped leaves connections behind; one that listens still refuses us.
  set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1);
  // Accepted sockets inherit these: as much waits in the system at most, in either direction.
  set_option(fd, SOL_SOCKET, SO_SNDBUF, 512 << 10);
  set_option(fd, SOL_SOCKET, SO_RCVBUF, 512 << 10);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  socklen_t length = sizeof address;
  if (bind(fd, generic, length) != 0 || listen(fd, SOMAXCONN) != 0 ||
      getsockname(fd, generic, &length) != 0)
    refuse_port(port);
  port_ = ntohs(address.sin_port);
  keep_reserve();
}

bool HubListener::keep_reserve() {
  if (!reserve_) reserve_.reset(open("/dev/null", O_RDONLY | O_CLOEXEC));
  return bool(reserve_);
}

HubListener::Arrival HubListener::accept() {
  for (int k = 0; k < most_failures; ++k) {
    sockaddr_in other{};
    socklen_t size = sizeof other;
    Descriptor taken(accept4(socket_.get(), reinterpret_cast<sockaddr*>(&other), &size,
                             SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (taken) {
      set_option(taken.get(), IPPROTO_TCP, TCP_NODELAY, 1);
      set_option(taken.get(), IPPROTO_TCP, TCP_QUICKACK, 1);
      // Others of 127.0.0.0/8 may have the same port.
      const bool usual = other.sin_addr.s_addr == htonl(INADDR_LOOPBACK);
      return {Outcome::accepted, std::move(taken), usual ? ntohs(other.sin_port) : uint16_t(0)};
    }
    if (concerns_one(errno)) continue;
    const bool nobody = errno == EAGAIN || errno == EWOULDBLOCK || !somebody_waits(socket_.get());
    return {nobody ? Outcome::nobody : Outcome::no_descriptor};
  }
  return {Outcome::nobody};
}

HubListener::Arrival HubListener::accept_with_reserve() {
  reserve_.reset();
  Arrival arrival = accept();
  if (!keep_reserve() && arrival.outcome == Outcome::accepted) {
    arrival = {Outcome::turned_away};
    keep_reserve();
  }
  return arrival;
}

void HubListener::close() {
  socket_.reset();
  reserve_.reset();
}

}  // namespace genio
