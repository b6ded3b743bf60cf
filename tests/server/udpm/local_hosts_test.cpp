#include "server/udpm/local_hosts.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace genio
