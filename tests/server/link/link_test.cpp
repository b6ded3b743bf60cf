// A connection, by whatever transport, and those who handle its messages.

#include "server/link/link.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "server/hub/hub.hpp"

namespace genio {
namespace {

TEST(Link, AHandlerThatFailsIsCountedAndTheNextMessageIsHandled) {
  const Hub hub(0);
  Link link("tcpq://127.0.0.1:" + std::to_string(hub.port()));
  int handled = 0;
  link.subscribe("BAD", [](const std::string&, const void*, size_t) {
    throw std::runtime_error("out of sorts");
  });
  link.subscribe("WORSE", [](const std::string&, const void*, size_t) { throw 7; });
  link.subscribe("GOOD", [&](const std::string&, const void*, size_t) { ++handled; });
  for (int k = 0; k < 100; ++k) link.publish("BAD", {1, 2, 3});
  link.publish("WORSE", {1});
  link.publish("GOOD", {1});
  for (int k = 0; k < 1000 && handled == 0; ++k) link.wait(100);
  EXPECT_EQ(handled, 1);
  EXPECT_EQ(link.counts().failed_handlings, 101u);
  EXPECT_FALSE(link.counts().udpm);
  const auto failures = link.take_failures();
  ASSERT_FALSE(failures.empty());
  EXPECT_LE(failures.size(), 100u);
  EXPECT_EQ(failures[0].channel, "BAD");
  EXPECT_EQ(failures[0].bytes, 3u);
  EXPECT_EQ(failures[0].reason, "out of sorts");
  EXPECT_TRUE(link.take_failures().empty());
}

}  // namespace
}  // namespace genio
