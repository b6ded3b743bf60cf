#include "server/udpm/local_hosts.hpp"

#include <sys/socket.h>

#include "server/hub/descriptor.hpp"

namespace genio {
namespace {

constexpr size_t most_known = 256;
constexpr std::chrono::seconds valid{10};

/// Only a host's own addresses can be bound to.
bool can_bind(in_addr host) {
  const Descriptor tried(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET, address.sin_addr = host;
  return tried && bind(tried.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
}

}  // namespace

bool LocalHosts::contain(in_addr address, UdpmTime now) {
  if (IN_MULTICAST(ntohl(address.s_addr))) return false;
  const auto it = known_.find(address.s_addr);
  if (it != known_.end() && now - it->second.asked < valid) return it->second.local;
  if (known_.size() >= most_known) known_.clear();
  const Known known{can_bind(address), now};
  known_[address.s_addr] = known;
  return known.local;
}

}  // namespace genio
