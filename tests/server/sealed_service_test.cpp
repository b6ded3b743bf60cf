// A service with a key, over tcpq on 127.0.0.1 through a hub on a free port.

#include <gtest/gtest.h>

#include <thread>

#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/journal/journal_view.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/seal/sample_key.hpp"

namespace genio {
namespace {

using test::sample_key;

class SealedService : public testing::Test {
 protected:
  void SetUp() override {
    options.url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
    options.key = sample_key();
    options.journal = folder.path() + "/journal";
    thread = std::thread([this] { serve(nursery, identities(models), options, stop); });
    client = std::make_unique<Client>(options.url, "honest", sample_key());
    ASSERT_TRUE(client->status(60));
  }
  void TearDown() override {
    client.reset();
    end_service();
  }
  void end_service() {
    stop = true;
    if (thread.joinable()) thread.join();
  }
  shape_request_t one_point(const std::string& id) const {
    const Vec3 top = 1e3 * model.mesh.nodes[size_t(model.landmarks.dorsum)];
    shape_request_t r{};
    r.id = id, r.client = "honest";
    r.point_count = 1;
    r.x_mm = {top[0]}, r.y_mm = {0}, r.z_mm = {top[2]}, r.sigma_mm = {1}, r.kind = {"dorsum"};
    r.bilateral = -1;
    return r;
  }
  /// A status that fulfils `enough`, or the last one.
  template <class Enough>
  server_status_t status_with(const Enough& enough) {
    server_status_t last{};
    for (int k = 0; k < 60; ++k) {
      if (const auto s = client->status(5)) last = *s;
      if (enough(last)) break;
    }
    return last;
  }
  std::vector<ServedModel> models = read_served_models({test::generic_model()});
  const Model& model = *models.front().model;
  const Nursery nursery{worker_of(models, 2000)};
  test::TemporaryFolder folder;
  Hub hub{0};
  ServiceOptions options;
  std::atomic<bool> stop{false};
  std::thread thread;
  std::unique_ptr<Client> client;
};

/// Publishes on a link of its own until its end.
class Attacker {
 public:
  using Act = std::function<void(Link& link)>;
  Attacker(const std::string& url, Act act)
      : thread_([this, url, act = std::move(act)] {
          Link link(url);
          while (!stop_) {
            act(link), ++rounds_;
            link.wait(2);
          }
        }) {}
  ~Attacker() {
    stop_ = true;
    thread_.join();
  }
  int rounds() const { return rounds_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<int> rounds_{0};
  std::thread thread_;
};

TEST_F(SealedService, AnswersOnlyWhoHasTheKey) {
  const auto reply = client->request(one_point("with"), 60);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, "converged") << reply->message;

  Client without(options.url, "without");
  const auto refused = without.request(one_point("none"), 60);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, "refused");
  EXPECT_NE(refused->message.find("key"), std::string::npos) << refused->message;
  EXPECT_FALSE(without.status(1.5));
  EXPECT_NE(without.doubt().find("--key is needed"), std::string::npos) << without.doubt();

  Client other(options.url, "other", sample_key(1));
  EXPECT_FALSE(other.request(one_point("other"), 2.5));
  EXPECT_NE(other.doubt().find("another key"), std::string::npos) << other.doubt();

  const auto s = status_with([](const auto& status) {
    return status.unsigned_dropped >= 2 && status.forged_dropped >= 2;
  });
  EXPECT_GE(s.unsigned_dropped, 2);  // a request, and a question for the status
  EXPECT_GE(s.forged_dropped, 2);    // two requests
  EXPECT_EQ(s.received, 1);
}

TEST_F(SealedService, AMessageThatIsSentAgainByAnotherIsDropped) {
  std::vector<uint8_t> recorded;
  Link recorder(options.url);
  recorder.subscribe("GENIO_REQUEST", [&](const std::string&, const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    recorded.assign(bytes, bytes + size);
  });
  recorder.wait(100);
  ASSERT_TRUE(client->request(one_point("once"), 60));
  for (int k = 0; k < 100 && recorded.empty(); ++k) recorder.wait(50);
  const int64_t received = client->status(20)->received;
  recorder.publish("GENIO_REQUEST", recorded);
  const auto s = status_with([](const auto& status) { return status.stale_dropped > 0; });
  EXPECT_EQ(s.stale_dropped, 1);
  EXPECT_EQ(s.received, received);
  // Its own sender may send it again, since it seals it anew.
  ASSERT_TRUE(client->request(one_point("once"), 60));
  EXPECT_GT(client->status(20)->received, received);
}

TEST_F(SealedService, NobodyFakesAnAnswerOrWithdrawsARequest) {
  command_reply_t fake{};
  fake.id = "wanted", fake.status = "converged", fake.wall_s = -1;
  cancel_t cancel{};
  cancel.id = "wanted", cancel.client = "honest";
  const Attacker attacker(options.url, [&](Link& link) {
    link.publish("GENIO_REPLY.honest", encode(fake));
    link.publish("GENIO_CANCEL", encode(cancel));
  });
  while (attacker.rounds() < 10) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const auto reply = client->request(one_point("wanted"), 60);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, "converged") << reply->message;
  EXPECT_GT(reply->wall_s, 0);
  // A client without a key would have taken it.
  const auto believed = Client(options.url, "honest").request(one_point("wanted"), 60);
  ASSERT_TRUE(believed);
  EXPECT_TRUE(believed->wall_s == -1 || believed->status == "refused");
}

TEST_F(SealedService, TheJournalKeepsRequestsWithoutTheirSeals) {
  ASSERT_TRUE(client->request(one_point("kept"), 60));
  client.reset();
  end_service();
  int entries = 0;
  JournalView(options.journal).each(Blobs::with, [&](const JournalEntry& entry, const auto&) {
    ++entries;
    std::string why;
    EXPECT_TRUE(decode_checked<shape_request_t>(entry.request.data(), entry.request.size(), why))
        << why;
    EXPECT_TRUE(decode_checked<command_reply_t>(entry.reply.data(), entry.reply.size(), why))
        << why;
  });
  EXPECT_EQ(entries, 1);
}

TEST(ServiceWithoutKey, IsNotBelievedByWhoHasOne) {
  const Hub hub(0);
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
  server_status_t status{};
  const Attacker plain(url, [&](Link& link) { link.publish("GENIO_STATUS", encode(status)); });
  Client client(url, "honest", sample_key());
  EXPECT_FALSE(client.status(1));
  EXPECT_NE(client.doubt().find("without --key"), std::string::npos) << client.doubt();
}

}  // namespace
}  // namespace genio
