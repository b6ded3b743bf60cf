#include "server/udpm/local_hosts.hpp"

#include <ifaddrs.h>
#include <net/if.h>

#include <algorithm>
#include <memory>

namespace genio {
namespace {

constexpr std::chrono::seconds valid{1};

}  // namespace

void LocalHosts::ask(UdpmTime now) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return;  // what was known will do
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(all, freeifaddrs);
  ranges_.clear();
  for (const ifaddrs* one = all; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET || !one->ifa_netmask) continue;
    const auto bits = [](const sockaddr* of) {
      return reinterpret_cast<const sockaddr_in*>(of)->sin_addr.s_addr;
    };
    // All of a loopback interface's network is this host: 127.x.y.z.
    const bool loopback = one->ifa_flags & IFF_LOOPBACK;
    ranges_.push_back({bits(one->ifa_addr), loopback ? bits(one->ifa_netmask) : INADDR_BROADCAST});
  }
  asked_ = now;
}

bool LocalHosts::contain(in_addr address, UdpmTime now) {
  if (address.s_addr == htonl(INADDR_ANY)) return true;
  if (!asked_ || now - *asked_ >= valid) ask(now);
  return std::any_of(ranges_.begin(), ranges_.end(), [&](const Range& range) {
    return ((address.s_addr ^ range.address) & range.mask) == 0;
  });
}

}  // namespace genio
