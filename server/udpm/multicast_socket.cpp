#include "server/udpm/multicast_socket.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace genio {
namespace {

constexpr int wished_buffer = 4 << 20;
constexpr size_t longest_datagram = 65536;

void require(bool good, const char* what) {
  if (!good) throw std::system_error(errno, std::generic_category(), what);
}

template <class T>
bool set(const Descriptor& socket, int level, int option, const T& value) {
  return setsockopt(socket.get(), level, option, &value, sizeof value) == 0;
}

Descriptor udp_socket() {
  Descriptor made(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  require(bool(made), "no socket");
  return made;
}

}  // namespace

MulticastSocket::MulticastSocket(const UdpmAddress& address)
    : sending_(udp_socket()), receiving_(udp_socket()), buffer_(longest_datagram) {
  group_.sin_family = AF_INET, group_.sin_addr = address.group,
  group_.sin_port = htons(address.port);
  const auto* const group = reinterpret_cast<const sockaddr*>(&group_);
  // Connecting tells whether there is a route; a connected socket does not reach its own host.
  require(connect(udp_socket().get(), group, sizeof group_) == 0, "no route to the group");
  require(set(sending_, IPPROTO_IP, IP_MULTICAST_TTL, address.ttl) &&
              set(sending_, IPPROTO_IP, IP_MULTICAST_LOOP, 1),
          "no multicast sending");
  // The system gives less where it must.
  set(receiving_, SOL_SOCKET, SO_RCVBUF,
      address.receive_buffer > 0 ? address.receive_buffer : wished_buffer);
  set(receiving_, SOL_SOCKET, SO_RXQ_OVFL, 1);
  require(set(receiving_, SOL_SOCKET, SO_REUSEADDR, 1), "no sharing of the port");
  require(bind(receiving_.get(), group, sizeof group_) == 0, "no binding to the group");
  ip_mreq membership{};
  membership.imr_multiaddr = address.group;
  require(set(receiving_, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership), "no joining of the group");
}

std::optional<MulticastSocket::Received> MulticastSocket::receive() {
  Received received;
  iovec place{buffer_.data(), buffer_.size()};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(uint32_t))];
  msghdr header{};
  header.msg_name = &received.source, header.msg_namelen = sizeof received.source;
  header.msg_iov = &place, header.msg_iovlen = 1;
  header.msg_control = control, header.msg_controllen = sizeof control;
  const ssize_t size = recvmsg(receiving_.get(), &header, MSG_DONTWAIT);
  if (size < 0) return std::nullopt;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c; c = CMSG_NXTHDR(&header, c))
    if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_RXQ_OVFL)
      std::memcpy(&overflowed_, CMSG_DATA(c), sizeof overflowed_);
  received.bytes = {buffer_.data(), size_t(size)};
  return received;
}

bool MulticastSocket::send(std::span<const uint8_t> bytes) {
  const auto* const group = reinterpret_cast<const sockaddr*>(&group_);
  return sendto(sending_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL, group,
                sizeof group_) == ssize_t(bytes.size());
}

}  // namespace genio
