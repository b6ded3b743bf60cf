#include "server/udpm/parts.hpp"

#include <gtest/gtest.h>

#include "server/udpm/datagram.hpp"
#include "tests/server/udpm/sample_parts.hpp"

namespace genio {
namespace {

using test::parts_of;
using test::sample_message;

TEST(Parts, EveryDatagramIsShortAndTheyAreTheMessage) {
  for (const size_t channel_bytes : {1, 20, 63})
    for (const size_t size : {1, 1400, 5000, 100000}) {
      const auto message = sample_message(size, 1, std::string(channel_bytes, 'c'));
      std::vector<uint8_t> joined;
      for (const part_t& part : parts_of(message)) {
        const auto bytes = encode(part);
        EXPECT_LE(datagram_bytes(part_channel, bytes.size()), 1400u);
        const bool last = part.index + 1 == part.count;
        EXPECT_TRUE(last || datagram_bytes(part_channel, bytes.size()) == 1400u) << "wasteful";
        joined.insert(joined.end(), part.data.begin(), part.data.end());
      }
      EXPECT_EQ(joined, message.bytes);
    }
}

// What docs/service.md says, and other languages compute: printf 'A\0abc' | sha256sum
TEST(Parts, TheDigestIsTheBeginningOfSha256) {
  const std::string text = "abc";
  EXPECT_EQ(message_digest("A", {reinterpret_cast<const uint8_t*>(text.data()), text.size()}),
            "736e2926f9245ea6bacea2b27435b82b");
}

TEST(Parts, AskIsShortToo) {
  part_ask_t ask{};
  ask.message = std::string(32, '0');
  ask.index.resize(ask_capacity(1400));
  ask.count = int32_t(ask.index.size());
  EXPECT_LE(datagram_bytes(part_ask_channel, encode(ask).size()), 1400u);
  EXPECT_GT(ask.count, 300);
}

}  // namespace
}  // namespace genio
