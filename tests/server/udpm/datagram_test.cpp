#include "server/udpm/datagram.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace genio {
namespace {

std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

UdpmDrop why_dropped(const std::string& bytes) {
  auto why = UdpmDrop::count;
  EXPECT_FALSE(read_datagram(bytes_of(bytes), why));
  return why;
}

TEST(UdpmDatagram, IsLcmsShortMessage) {
  const auto made = make_datagram(0x01020304, "CHANNEL", bytes_of("payload"));
  EXPECT_EQ(made, bytes_of(std::string("LC02\1\2\3\4CHANNEL\0payload", 23)));
  EXPECT_EQ(made.size(), datagram_bytes("CHANNEL", 7));
}

TEST(UdpmDatagram, WhatIsWrittenIsRead) {
  for (const size_t channel_bytes : {0, 1, 63})
    for (const size_t size : {0, 1, 65000}) {
      const std::string channel(channel_bytes, 'c');
      const std::vector<uint8_t> payload(size, 0);
      const auto made = make_datagram(7, channel, payload);
      auto why = UdpmDrop::count;
      const auto read = read_datagram(made, why);
      ASSERT_TRUE(read);
      EXPECT_EQ(read->channel, channel);
      EXPECT_EQ(read->payload.size(), size);
    }
}

TEST(UdpmDatagram, AllElseIsDroppedForItsReason) {
  EXPECT_EQ(why_dropped(""), UdpmDrop::not_lcm);
  EXPECT_EQ(why_dropped("LC02"), UdpmDrop::not_lcm);
  EXPECT_EQ(why_dropped(std::string("LC02\0\0\0", 7)), UdpmDrop::not_lcm);
  EXPECT_EQ(why_dropped("LC01....A"), UdpmDrop::not_lcm);
  EXPECT_EQ(why_dropped(std::string("LC03....A\0", 10)), UdpmDrop::fragment);
  EXPECT_EQ(why_dropped("LC02...."), UdpmDrop::bad_channel);
  EXPECT_EQ(why_dropped("LC02....no end"), UdpmDrop::bad_channel);
  EXPECT_EQ(why_dropped("LC02...." + std::string(64, 'c') + std::string(1, '\0')),
            UdpmDrop::bad_channel);
}

TEST(UdpmDatagram, AnyBytesAreReadOrDropped) {
  std::mt19937 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string bytes(random() % 200, '\0');
    for (char& c : bytes) c = char(random() % 4 ? random() : 0);
    if (k % 2) bytes.insert(0, "LC02");
    // A vector of its own, so that a sanitizer sees what is read beside it.
    const auto own = bytes_of(bytes);
    auto why = UdpmDrop::count;
    const auto read = read_datagram(own, why);
    EXPECT_TRUE(read || why != UdpmDrop::count);
    if (!read) continue;
    EXPECT_EQ(datagram_bytes(read->channel, read->payload.size()), own.size());
  }
}

}  // namespace
}  // namespace genio
