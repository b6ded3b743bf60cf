// The service over tcpq on 127.0.0.1, through a hub on a free port.

#include "server/service.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <thread>

#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/served_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class Service : public testing::Test {
 protected:
  void SetUp() override {
    options.url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
    thread = std::thread([this] { serve(nursery, identities(models), options, stop); });
    client = std::make_unique<Client>(options.url);
    ASSERT_TRUE(client->status(20));
  }
  void TearDown() override {
    client.reset();
    stop = true;
    if (thread.joinable()) thread.join();
  }
  shape_request_t one_point() const {
    const Vec3 top = 1e3 * model.mesh.nodes[size_t(model.landmarks.dorsum)];
    shape_request_t r{};
    r.point_count = 1;
    r.x_mm = {top[0]}, r.y_mm = {0}, r.z_mm = {top[2]}, r.sigma_mm = {1}, r.kind = {"dorsum"};
    r.bilateral = -1;
    return r;
  }
  std::vector<ServedModel> models = read_served_models({test::generic_model()});
  const Model& model = *models.front().model;
  const Nursery nursery{worker_of(models, 2000)};
  Hub hub{0};
  ServiceOptions options;
  std::atomic<bool> stop{false};
  std::thread thread;
  std::unique_ptr<Client> client;
};

TEST_F(Service, AnswersAShape) {
  const auto reply = client->request(one_point(), 60);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, "converged") << reply->message;
  EXPECT_EQ(reply->verdict, "explained");
  EXPECT_EQ(reply->muscle_count, 11);
  EXPECT_GT(reply->line_count, 10);
}

TEST_F(Service, SameIdGetsTheSameReply) {
  auto r = one_point();
  r.id = "twice";
  const auto first = client->request(r, 60);
  const auto second = client->request(r, 60);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->wall_s, second->wall_s);  // computed once
  EXPECT_EQ(first->force_N, second->force_N);
}

TEST_F(Service, BadRequestsAreRefusedAndServingGoesOn) {
  auto nan = one_point();
  nan.x_mm[0] = std::nan("");
  auto empty = one_point();
  empty.point_count = 0;
  empty.x_mm.clear(), empty.y_mm.clear(), empty.z_mm.clear(), empty.sigma_mm.clear(),
      empty.kind.clear();
  auto unknown = one_point();
  unknown.kind[0] = "tipp";
  auto far = one_point();
  far.x_mm[0] = 1e5;
  for (const auto& [request, word] : {std::pair{nan, "point 1"},
                                      {empty, "no points"},
                                      {unknown, "did you mean tip"},
                                      {far, "Wrong units"}}) {
    const auto reply = client->request(request, 30);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->status, "failed");
    EXPECT_NE(reply->message.find(word), std::string::npos) << reply->message;
  }
  const auto good = client->request(one_point(), 60);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->status, "converged");
}

TEST_F(Service, GarbageOnTheRequestChannelDoesNoHarm) {
  Link link(options.url);
  bool told = false;
  link.subscribe("GENIO_REPLY.undecodable",
                 [&](const std::string&, const void*, size_t) { told = true; });
  link.wait(100);
  link.publish("GENIO_REQUEST", {1, 2, 3});
  link.publish("GENIO_REQUEST", std::vector<uint8_t>(100000, 0xff));
  for (int i = 0; i < 50 && !told; ++i) link.wait(100);
  EXPECT_TRUE(told);
  EXPECT_TRUE(client->request(one_point(), 60));
}

TEST_F(Service, StoppingServerRepliesToAllThatWait) {
  Link link(options.url);
  int replies = 0;
  link.subscribe("GENIO_REPLY.waiter", [&](const std::string&, const void*, size_t) { ++replies; });
  link.wait(100);
  auto r = one_point();
  r.client = "waiter";
  for (const char* id : {"a", "b", "c"}) {
    r.id = id;
    link.publish("GENIO_REQUEST", encode(r));
  }
  for (int i = 0; i < 100 && client->status(5)->received < 3; ++i) {
  }
  stop = true;
  thread.join();
  hub.flush(std::chrono::seconds(5));
  for (int i = 0; i < 50 && replies < 3; ++i) link.wait(100);
  EXPECT_EQ(replies, 3);
}

/// What `work` prints on standard error, the C library's included.
std::string errors_of(const std::function<void()>& work) {
  testing::internal::CaptureStderr();
  work();
  return testing::internal::GetCapturedStderr();
}

TEST(Link, NothingIsPrintedWhereNobodyListens) {
  Hub reserved(0);
  const std::string url = "tcpq://127.0.0.1:" + std::to_string(reserved.port());
  std::string free;  // a port that was just given back
  { free = "tcpq://127.0.0.1:" + std::to_string(Hub(0).port()); }
  EXPECT_EQ(errors_of([&] {
              Client client(free);
              EXPECT_FALSE(client.connected());
              EXPECT_FALSE(client.request({}, 0.5));
              EXPECT_FALSE(client.status(0.2));
            }),
            "");
  EXPECT_TRUE(Client(url).connected());
}

// A million points once reset the connection, and the client waited out its time.
TEST(Link, ARequestThatNoServerTakesIsRefusedBeforeItIsSent) {
  const Hub hub(0);
  Client client("tcpq://127.0.0.1:" + std::to_string(hub.port()));
  shape_request_t r{};
  r.point_count = 1000000;
  for (auto* v : {&r.x_mm, &r.y_mm, &r.z_mm, &r.sigma_mm}) v->resize(size_t(r.point_count));
  r.kind.resize(size_t(r.point_count));
  EXPECT_THROW(client.request(r, 60), InputError);
  EXPECT_TRUE(client.connected());
}

TEST(Link, AServerThatComesLaterIsFound) {
  auto first = std::make_unique<Hub>(0);
  const uint16_t port = first->port();
  first.reset();
  Link link("tcpq://127.0.0.1:" + std::to_string(port));
  EXPECT_FALSE(link.connected());
  int came = 0;
  link.subscribe("LATE", [&](const std::string&, const void*, size_t) { ++came; });
  const Hub hub(port);
  for (int k = 0; k < 50 && came == 0; ++k) {
    link.publish("LATE", {1, 2, 3});
    link.wait(100);
  }
  EXPECT_GT(came, 0);
}

TEST(Link, AUrlThatIsNoneIsRefused) {
  for (const char* url : {"tcpq://127.0.0.1:99999", "tcpq://host:port", "nothing://x", "tcpq"})
    EXPECT_THROW(Link{url}, InputError) << url;
}

}  // namespace
}  // namespace genio
