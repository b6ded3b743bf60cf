#include "server/udpm/udpm_address.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>

namespace genio {
namespace {

std::string text_of(const UdpmAddress& a) {
  char group[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &a.group, group, sizeof group);
  return std::string(group) + ":" + std::to_string(a.port) + " ttl " + std::to_string(a.ttl) +
         " buffer " + std::to_string(a.receive_buffer);
}

TEST(UdpmAddress, WhatIsLeftOutIsAsInLcm) {
  for (const auto& [url, meaning] : {std::pair("udpm://", "239.255.76.67:7667 ttl 0 buffer 0"),
                                     {"udpm://?ttl=1", "239.255.76.67:7667 ttl 1 buffer 0"},
                                     {"udpm://239.1.2.3:77", "239.1.2.3:77 ttl 0 buffer 0"},
                                     {"udpm://239.1.2.3:77?", "239.1.2.3:77 ttl 0 buffer 0"},
                                     {"udpm://224.0.0.1:65535?ttl=255&recv_buf_size=2097152",
                                      "224.0.0.1:65535 ttl 255 buffer 2097152"}}) {
    std::string why;
    const auto address = udpm_address(url, why);
    ASSERT_TRUE(address) << url << ": " << why;
    EXPECT_EQ(text_of(*address), meaning) << url;
  }
}

TEST(UdpmAddress, WhatIsWrongIsNamed) {
  for (const auto& [url, word] : {std::pair("tcpq://239.1.2.3:77", "udpm://"),
                                  {"udpm:/239.1.2.3:77", "udpm://"},
                                  {"udpm://127.0.0.1:77", "group"},
                                  {"udpm://240.0.0.1:77", "group"},
                                  {"udpm://239.255.76.067:77", "group"},
                                  {"udpm://239.255:77", "group"},
                                  {"udpm://group:77", "group"},
                                  {"udpm://:77", "group"},
                                  {"udpm://239.1.2.3", "port"},
                                  {"udpm://239.1.2.3:", "port"},
                                  {"udpm://239.1.2.3:0", "port"},
                                  {"udpm://239.1.2.3:07667", "port"},
                                  {"udpm://239.1.2.3:0x10", "port"},
                                  {"udpm://239.1.2.3:65536", "port"},
                                  {"udpm://239.1.2.3:77/", "port"},
                                  {"udpm://239.1.2.3:77?ttl=256", "ttl"},
                                  {"udpm://239.1.2.3:77?ttl=-1", "ttl"},
                                  {"udpm://239.1.2.3:77?ttl=", "ttl"},
                                  {"udpm://239.1.2.3:77?ttl", "ttl"},
                                  {"udpm://239.1.2.3:77?recv_buf_size=1e6", "recv_buf_size"},
                                  {"udpm://239.1.2.3:77?hops=1", "hops"}}) {
    std::string why;
    EXPECT_FALSE(udpm_address(url, why)) << url;
    EXPECT_NE(why.find(word), std::string::npos) << url << ": " << why;
  }
  std::string why;
  EXPECT_FALSE(udpm_address(std::string("udpm://239.1.2.3\0:77", 20), why));
  EXPECT_FALSE(udpm_address("udpm://" + std::string(1 << 20, '1'), why));
}

}  // namespace
}  // namespace genio
