// Links with a key over tcpq on 127.0.0.1, through a hub on a free port.

#include "server/seal/sealed_link.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "server/hub/hub.hpp"
#include "server/seal/seal.hpp"
#include "tests/server/seal/sample_key.hpp"

namespace genio {
namespace {

using test::sample_key;

const std::string sealed_channel = "A.CHANNEL";
const std::vector<uint8_t> content = {1, 2, 3};

class SealedLinks : public testing::Test {
 protected:
  void SetUp() override {
    const auto counting = [this](const std::string&, const void* data, size_t size) {
      const auto* bytes = static_cast<const uint8_t*>(data);
      EXPECT_EQ(std::vector<uint8_t>(bytes, bytes + size), content);
      ++taken;
    };
    receiver.subscribe(sealed_channel, counting);
    receiver.subscribe("A\\..*", counting);
    reader.subscribe(sealed_channel, [this](const std::string&, const void* data, size_t size) {
      const auto* bytes = static_cast<const uint8_t*>(data);
      seen.assign(bytes, bytes + size);
    });
    reader.wait(50);
    receiver.wait(50);
  }
  /// Until `enough`, or some seconds.
  void wait_for(const std::function<bool()>& enough) {
    for (int k = 0; k < 200 && !enough(); ++k) receiver.wait(20), reader.wait(20);
    EXPECT_TRUE(enough());
  }
  Hub hub{0};
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
  SealedLink receiver{url, sample_key()};
  Link reader{url};           // sees all, has no key
  std::vector<uint8_t> seen;  // by it
  int taken = 0;              // by two subscriptions
};

TEST_F(SealedLinks, TakeWhatIsSealedWithTheSameKeyEachTimeItIsSealed) {
  SealedLink sender(url, sample_key());
  ASSERT_TRUE(sender.publish(sealed_channel, content));
  ASSERT_TRUE(sender.publish(sealed_channel, content));
  wait_for([&] { return taken == 4; });
  EXPECT_NE(seen, content);
  EXPECT_TRUE(looks_sealed(seen.data(), seen.size()));
  EXPECT_EQ(receiver.dropped().stale, 0);
}

TEST_F(SealedLinks, DropAndCountAllElse) {
  ASSERT_TRUE(SealedLink(url, sample_key()).publish(sealed_channel, content));
  wait_for([&] { return taken == 2 && !seen.empty(); });
  const auto replayed = seen;
  ASSERT_TRUE(reader.publish(sealed_channel, replayed));
  wait_for([&] { return receiver.dropped().stale == 2; });
  ASSERT_TRUE(SealedLink(url, sample_key(1)).publish(sealed_channel, content));
  wait_for([&] { return receiver.dropped().forged == 2; });
  ASSERT_TRUE(reader.publish("A.NOTHER", replayed));  // moved to another channel
  wait_for([&] { return receiver.dropped().forged == 3; });
  ASSERT_TRUE(reader.publish(sealed_channel, content));
  wait_for([&] { return receiver.dropped().unsealed == 2; });
  const auto old = seal(*sample_key(), sealed_channel, content, now_us() - 60'000'000, new_nonce());
  ASSERT_TRUE(reader.publish(sealed_channel, old));
  wait_for([&] { return receiver.dropped().stale == 4; });
  EXPECT_EQ(taken, 2);
}

TEST_F(SealedLinks, AReceiverThatBeginsAgainTakesNothingFromBefore) {
  const auto before =
      seal(*sample_key(), sealed_channel, content, now_us() - 5'000'000, new_nonce());
  ASSERT_TRUE(reader.publish(sealed_channel, before));
  wait_for([&] { return receiver.dropped().stale == 2; });
  EXPECT_EQ(taken, 0);
}

TEST_F(SealedLinks, WithoutAKeyEverythingPassesAsItIs) {
  SealedLink plain(url);
  std::vector<uint8_t> came;
  plain.subscribe("PLAIN", [&](const std::string&, const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    came.assign(bytes, bytes + size);
  });
  plain.wait(50);
  ASSERT_TRUE(plain.publish("PLAIN", content));
  for (int k = 0; k < 200 && came.empty(); ++k) plain.wait(20);
  EXPECT_EQ(came, content);
  EXPECT_EQ(plain.doubt(), "");
  ASSERT_TRUE(SealedLink(url, sample_key()).publish("PLAIN", content));
  for (int k = 0; k < 200 && plain.doubt().empty(); ++k) plain.wait(20);
  EXPECT_NE(plain.doubt().find("--key"), std::string::npos) << plain.doubt();
}

}  // namespace
}  // namespace genio
