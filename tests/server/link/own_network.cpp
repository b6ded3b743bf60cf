#include "tests/server/link/own_network.hpp"

#include <arpa/inet.h>
#include <net/if.h>
#include <net/route.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cstring>
#include <thread>

#include "server/hub/descriptor.hpp"

namespace genio::test {
namespace {

bool set_up(Routes routes) {
  char loopback[IFNAMSIZ] = "lo";
  const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq interface {};
  std::memcpy(interface.ifr_name, loopback, sizeof loopback);
  if (ioctl(socket.get(), SIOCGIFFLAGS, &interface) != 0) return false;
  interface.ifr_flags = short(interface.ifr_flags | IFF_UP | IFF_MULTICAST);
  if (ioctl(socket.get(), SIOCSIFFLAGS, &interface) != 0) return false;
  if (routes == Routes::none) return true;
  rtentry route{};
  const auto set = [](sockaddr& to, const char* address) {
    sockaddr_in in{};
    in.sin_family = AF_INET, in.sin_addr.s_addr = inet_addr(address);
    std::memcpy(&to, &in, sizeof in);
  };
  set(route.rt_dst, "224.0.0.0"), set(route.rt_genmask, "240.0.0.0");
  route.rt_flags = RTF_UP, route.rt_dev = loopback;
  return ioctl(socket.get(), SIOCADDRT, &route) == 0;
}

}  // namespace

bool in_own_network(const std::function<void()>& work, Routes routes) {
  bool ran = false;
  std::thread([&] {
    if (unshare(CLONE_NEWNET) != 0 || !set_up(routes)) return;
    ran = true;
    work();
  }).join();
  return ran;
}

}  // namespace genio::test
