#include "server/link/tcp_address.hpp"

#include <gtest/gtest.h>

#include "forward/base/types.hpp"
#include "server/hub/hub.hpp"
#include "server/link/link.hpp"

namespace genio {
namespace {

TEST(TcpAddress, EverySpellingOfThisHostIsLocal) {
  for (const char* host :
       {"127.0.0.1", "127.0.0.01", "127.1", "127.0.0.2", "127.255.255.254", "0177.0.0.1", "0x7f.1",
        "2130706433", "localhost", "LOCALHOST", "0", "0.0.0.0", ""})
    EXPECT_EQ(local_tcpq_port(std::string("tcpq://") + host + ":7712"), 7712) << host;
  for (const char* url : {"tcpq://127.0.0.1", "tcpq://localhost/", "tcpq://", "tcpq://127.1?a=b"})
    EXPECT_EQ(local_tcpq_port(url), 7700) << url;
  EXPECT_EQ(local_tcpq_port("tcpq://127.0.0.1:7712/?x=1"), 7712);
  EXPECT_EQ(local_tcpq_port("tcpq://:7712"), 7712);
}

TEST(TcpAddress, OtherHostsAndTransportsAreNot) {
  for (const char* url :
       {"tcpq://10.0.0.1:7700", "tcpq://128.0.0.1", "tcpq://126.255.255.255", "tcpq://1.2.3.4",
        "tcpq://nobody.invalid:7700", "udpm://239.255.76.67:7667", "memq://", "TCPQ://127.0.0.1"})
    EXPECT_EQ(local_tcpq_port(url), 0) << url;
}

TEST(TcpAddress, WhatLcmWouldReadOtherwiseIsNoUrl) {
  for (const char* url : {"tcpq://127.0.0.1:07712", "tcpq://127.0.0.1:0x1e20", "tcpq://127.0.0.1:0",
                          "tcpq://127.0.0.1:65536", "tcpq://127.0.0.1:", "tcpq://127.0.0.1:-1",
                          "tcpq://127.0.0.1:7712x", "tcpq://127.0.0.1 :7712", "tcpq://a/b:7712",
                          "tcpq:/127.0.0.1", "tcpqs://127.0.0.1", "tcpq://::1:7712"}) {
    EXPECT_FALSE(tcp_address(url)) << url;
    EXPECT_EQ(local_tcpq_port(url), 0) << url;
  }
  EXPECT_FALSE(tcp_address("tcpq://" + std::string(1 << 20, 'a')));
  EXPECT_FALSE(tcp_address(std::string("tcpq://127.0.0.1\0x", 18)));
  EXPECT_THROW(Link("tcpq://127.0.0.1:07712"), InputError);
}

/// LCM 1.3.1 by itself goes to this host for every name that is no number.
TEST(TcpAddress, ALinkGoesWhereItsUrlSays) {
  const Hub hub(0);
  const std::string port = ":" + std::to_string(hub.port());
  for (const char* here : {"localhost", "127.1", "127.0.0.2", "0", ""})
    EXPECT_TRUE(Link("tcpq://" + std::string(here) + port).connected()) << here;
  EXPECT_FALSE(Link("tcpq://nobody.invalid" + port).connected());
}

}  // namespace
}  // namespace genio
