// Messages over UDP multicast, in a network of the test's own.

#include "server/link/udpm_link.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <net/if.h>
#include <sys/socket.h>

#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <thread>

#include "forward/base/types.hpp"
#include "server/link/link.hpp"
#include "server/udpm/datagram.hpp"
#include "tests/server/hub/raw_client.hpp"
#include "tests/server/link/own_network.hpp"
#include "tests/server/udpm/sample_parts.hpp"

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
using test::sample_message;

const std::string group_url = "udpm://239.255.76.67:7667?ttl=0";

/// A test of that name in a network of its own, or none where there cannot be one.
#define IN_OWN_NETWORK(name)                                           \
  void own_network_##name();                                           \
  TEST(UdpmLink, name) {                                               \
    if (!test::in_own_network(own_network_##name))                     \
      GTEST_SKIP() << "this process may not make a network namespace"; \
  }                                                                    \
  void own_network_##name()

/// Takes messages of all channels.
struct Listener {
  explicit Listener(const UdpmLimits& limits = {}) : link(group_url, limits) {
    link.subscribe(".*", [this](const std::string& channel, const void* data, size_t size) {
      const auto* bytes = static_cast<const uint8_t*>(data);
      came.emplace(channel, std::vector<uint8_t>(bytes, bytes + size));
    });
  }
  /// Waits for so many, while `other` sends what it has to send.
  bool hears(size_t count, UdpmLink* other = nullptr) {
    return eventually(
        [&] {
          if (other) other->wait(0, {});
          link.wait(2, {});
          return came.size() >= count;
        },
        milliseconds(30000));
  }
  UdpmLink link;
  std::multimap<std::string, std::vector<uint8_t>> came;
};

/// Sends raw datagrams from a port of its own.
struct RawSender {
  RawSender() : socket(::socket(AF_INET, SOCK_DGRAM, 0)) {}
  void send(const std::string& bytes, const char* host = "239.255.76.67") const {
    sockaddr_in to{};
    to.sin_family = AF_INET, to.sin_port = htons(7667), to.sin_addr.s_addr = inet_addr(host);
    EXPECT_EQ(sendto(socket.get(), bytes.data(), bytes.size(), 0,
                     reinterpret_cast<const sockaddr*>(&to), sizeof to),
              ssize_t(bytes.size()))
        << std::strerror(errno);
  }
  Descriptor socket;
};

std::string big_endian(uint32_t word) {
  return {char(word >> 24), char(word >> 16), char(word >> 8), char(word)};
}

/// A fragment as LCM sends it: of message 1, of `size` bytes.
std::string fragment(uint32_t size, uint32_t offset, const std::string& rest, int number) {
  return "LC03" + big_endian(1) + big_endian(size) + big_endian(offset) +
         big_endian(uint32_t(number) << 16 | 2) + rest;
}

IN_OWN_NETWORK(MessagesOfAllSizesArrive) {
  Listener listener;
  UdpmLink sender(group_url);
  size_t sent = 0;
  for (const size_t size : {0, 1, 1000, 1400, 1401, 20000, 100000, 1 << 20, 4 << 20}) {
    const auto message = sample_message(size, 1, "SIZE" + std::to_string(size));
    EXPECT_TRUE(sender.publish(message.channel, message.bytes));
    ASSERT_TRUE(listener.hears(++sent, &sender)) << size;
    EXPECT_TRUE(listener.came.find(message.channel)->second == message.bytes) << size;
  }
  EXPECT_EQ(sender.counts().joined, 0u);  // it wants nothing
}

IN_OWN_NETWORK(AReceiverWithTheUsualBufferGetsFourMebibytes) {
  UdpmLink reader(group_url + "&recv_buf_size=106496");  // the system doubles it to 208 kB
  bool came = false;
  reader.subscribe("LONG", [&](const std::string&, const void*, size_t) { came = true; });
  UdpmLink sender(group_url);
  const auto message = sample_message(4 << 20);
  sender.publish("LONG", message.bytes);
  EXPECT_TRUE(eventually([&] { return sender.wait(1, {}), reader.wait(1, {}), came; },
                         milliseconds(30000)));
}

IN_OWN_NETWORK(WhatItSendsComesBackAsWithLcm) {
  Listener listener;
  listener.link.publish("SHORT", {1, 2, 3});
  listener.link.publish("LONG", sample_message(10000).bytes);
  EXPECT_TRUE(listener.hears(2));
}

IN_OWN_NETWORK(LcmsProgramsHearUsAndAreHeard) {
  lcm_t* const lcm = lcm_create(group_url.c_str());
  ASSERT_TRUE(lcm);
  std::map<std::string, std::string> heard;
  lcm_subscribe(
      lcm, ".*",
      [](const lcm_recv_buf_t* buffer, const char* channel, void* user) {
        (*static_cast<std::map<std::string, std::string>*>(user))[channel].assign(
            static_cast<const char*>(buffer->data), buffer->data_size);
      },
      &heard);
  Listener listener;
  const auto message = sample_message(1000, 1, "FROM_US");
  EXPECT_TRUE(listener.link.publish(message.channel, message.bytes));
  EXPECT_TRUE(eventually([&] {
    lcm_handle_timeout(lcm, 100);
    return heard.contains(message.channel);
  }));
  EXPECT_EQ(heard[message.channel], std::string(message.bytes.begin(), message.bytes.end()));
  listener.came.clear();
  const std::string large(65000, 'x');  // one datagram of LCM's
  lcm_publish(lcm, "FROM_LCM", "abc", 3);
  lcm_publish(lcm, "LARGE", large.data(), unsigned(large.size()));
  EXPECT_TRUE(eventually([&] {
    listener.link.wait(10, {});
    return listener.came.contains("FROM_LCM") && listener.came.contains("LARGE");
  }));
  EXPECT_EQ(listener.came.find("LARGE")->second.size(), large.size());
  lcm_destroy(lcm);
}

// Of these LCM 1.3.1 copies the second to four gigabytes behind a buffer of a hundred bytes.
IN_OWN_NETWORK(FragmentsThatKillLcmDoNothing) {
  Listener listener;
  const RawSender sender;
  const std::string channel("CHANNEL\0", 8);
  sender.send(fragment(100, 0, channel + "data", 0));
  sender.send(fragment(100, 0xfffffff0, std::string(0x20, 'x'), 1));
  sender.send(std::string("LC02\0\0\0\1AFTER\0abc", 17));
  ASSERT_TRUE(listener.hears(1));
  EXPECT_EQ(listener.came.begin()->first, "AFTER");
  EXPECT_EQ(listener.link.counts().dropped(UdpmDrop::fragment), 2u);
}

IN_OWN_NETWORK(WhatIsNoMessageIsDroppedAndCounted) {
  Listener listener;
  const RawSender sender;
  const auto lcm = [](std::string_view channel, const std::string& payload) {
    const auto made =
        make_datagram(0, channel, std::vector<uint8_t>(payload.begin(), payload.end()));
    return std::string(made.begin(), made.end());
  };
  for (const std::string& bytes :
       {std::string(), std::string("LC"), std::string(65507, 'x'), std::string("LC02....NO_END"),
        lcm(std::string(64, 'c'), ""), lcm(part_channel, ""), lcm(part_channel, "junk"),
        lcm(part_ask_channel, std::string(1000, '\xff'))})
    sender.send(bytes);
  listener.link.publish("AFTER", {});
  ASSERT_TRUE(listener.hears(1));
  EXPECT_EQ(listener.came.size(), 1u);
  const UdpmCounts counts = listener.link.counts();
  EXPECT_EQ(counts.dropped(UdpmDrop::not_lcm), 3u);
  EXPECT_EQ(counts.dropped(UdpmDrop::bad_channel), 2u);
  EXPECT_EQ(counts.dropped(UdpmDrop::bad_part), 3u);
}

// LCM 1.3.1 takes what is sent to any address of the host.
IN_OWN_NETWORK(OnlyTheGroupIsHeard) {
  Listener listener;
  const RawSender sender;
  const std::string message("LC02\0\0\0\1UNICAST\0abc", 19);
  sender.send(message, "127.0.0.1");
  sender.send(message, "239.255.76.68");
  listener.link.publish("AFTER", {});
  ASSERT_TRUE(listener.hears(1));
  EXPECT_EQ(listener.came.begin()->first, "AFTER");
  EXPECT_EQ(listener.link.counts().datagrams_in, 1u);
}

// As a server that was told to stop, and sends its last replies.
IN_OWN_NETWORK(ALinkThatEndsSendsFirstWhatWaits) {
  Listener listener;
  std::optional<UdpmLink> sender(std::in_place, group_url);
  const auto message = sample_message(1 << 20);
  sender->publish("LAST", message.bytes);
  std::thread ending([&] { sender.reset(); });
  EXPECT_TRUE(listener.hears(1));
  ending.join();
}

IN_OWN_NETWORK(WhatCanNeverBeSentHoldsNothingUp) {
  UdpmLink sender(group_url);
  EXPECT_TRUE(sender.publish(std::string(64, 'c'), {1}));
  EXPECT_TRUE(sender.publish("TOO_LONG", std::vector<uint8_t>(5 << 20)));
  EXPECT_EQ(sender.counts().unsendable, 2u);
  EXPECT_EQ(sender.counts().datagrams_out, 0u);
}

IN_OWN_NETWORK(WaitingEndsWhenSomethingElseIsReadable) {
  UdpmLink link(group_url);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const Descriptor reading(ends[0]), writing(ends[1]);
  ASSERT_EQ(write(writing.get(), "x", 1), 1);
  const UdpmTime begin = UdpmClock::now();
  EXPECT_TRUE(link.wait(60000, std::array{reading.get()}));
  EXPECT_LT(UdpmClock::now() - begin, std::chrono::seconds(30));
}

IN_OWN_NETWORK(WhereTtlIsZeroOtherHostsAreNotHeard) {
  Listener here;
  UdpmLink everywhere("udpm://239.255.76.67:7667?ttl=1");
  int came = 0;
  everywhere.subscribe("STRANGER", [&](const std::string&, const void*, size_t) { ++came; });
  const RawSender stranger;
  const int fd = stranger.socket.get(), yes = 1;
  ip_mreqn loopback{};
  loopback.imr_ifindex = int(if_nametoindex("lo"));
  sockaddr_in elsewhere{};
  elsewhere.sin_family = AF_INET, elsewhere.sin_addr.s_addr = inet_addr("192.0.2.1");
  ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_TRANSPARENT, &yes, sizeof yes), 0);
  ASSERT_EQ(setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback), 0);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&elsewhere), sizeof elsewhere), 0);
  stranger.send(std::string("LC02\0\0\0\1STRANGER\0abc", 20));
  here.link.publish("AFTER", {});
  ASSERT_TRUE(here.hears(1));
  EXPECT_EQ(here.came.begin()->first, "AFTER");
  EXPECT_EQ(here.link.counts().dropped(UdpmDrop::foreign), 1u);
  EXPECT_TRUE(eventually([&] { return everywhere.wait(10, {}), came == 1; }));
}

TEST(UdpmLink, WhatIsNoUrlOfAGroupIsRefused) {
  for (const char* url : {"udpm://10.0.0.1:7667", "udpm://239.1.1.1", "udpm:", "udpm",
                          "mpudpm://239.255.76.67:7667", "memq://"})
    EXPECT_THROW(Link{url}, InputError) << url;
}

TEST(UdpmLink, WithoutARouteTheReasonIsTold) {
  const bool ran = test::in_own_network(
      [] {
        try {
          const UdpmLink link(group_url);
          ADD_FAILURE() << "there is no route";
        } catch (const InputError& e) {
          EXPECT_NE(std::string(e.what()).find("no route to the group"), std::string::npos);
        }
      },
      test::Routes::none);
  if (!ran) GTEST_SKIP() << "this process may not make a network namespace";
}

}  // namespace
}  // namespace genio
