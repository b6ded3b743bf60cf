#include "server/udpm/local_hosts.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <fstream>

#include "server/hub/descriptor.hpp"
#include "tests/server/link/own_network.hpp"

namespace genio {
namespace {

TEST(LocalHosts, AreTheAddressesOfThisHost) {
  LocalHosts hosts;
  UdpmTime now{std::chrono::hours(1)};
  for (int k = 0; k < 2; ++k, now += std::chrono::seconds(11)) {
    for (const char* own : {"127.0.0.1", "127.1.2.3", "0.0.0.0"})
      EXPECT_TRUE(hosts.contain({inet_addr(own)}, now)) << own;
    for (const char* other : {"192.0.2.1", "198.51.100.7", "239.255.76.67"})
      EXPECT_FALSE(hosts.contain({inet_addr(other)}, now)) << other;
  }
}

// Then every address can be bound to, and once all of them counted as this host's.
TEST(LocalHosts, AreNoMoreWhereForeignAddressesCanBeBoundTo) {
  const bool ran = test::in_own_network([] {
    std::ofstream setting("/proc/sys/net/ipv4/ip_nonlocal_bind");
    setting << 1 << std::flush;
    ASSERT_TRUE(setting);
    const Descriptor tried(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_in foreign{};
    foreign.sin_family = AF_INET, foreign.sin_addr.s_addr = inet_addr("192.0.2.1");
    ASSERT_EQ(bind(tried.get(), reinterpret_cast<sockaddr*>(&foreign), sizeof foreign), 0);
    LocalHosts hosts;
    const UdpmTime now{std::chrono::hours(1)};
    EXPECT_FALSE(hosts.contain({inet_addr("192.0.2.1")}, now));
    EXPECT_TRUE(hosts.contain({inet_addr("127.0.0.1")}, now));
  });
  if (!ran) GTEST_SKIP() << "this process may not make a network namespace";
}

}  // namespace
}  // namespace genio
