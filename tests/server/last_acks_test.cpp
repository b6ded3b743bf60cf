// What clients have said before a server with a journal ends is no less true afterwards.

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/journal/journal.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

/// Points that no model can take, so that the answer comes at once.
shape_request_t answered_at_once(const std::string& id) {
  shape_request_t r{};
  r.id = id, r.client = "late", r.bilateral = -1, r.point_count = 1;
  r.x_mm = {std::nan("")}, r.y_mm = {0}, r.z_mm = {0}, r.sigma_mm = {1}, r.kind = {"dorsum"};
  return r;
}

std::vector<uint8_t> ack_of(const std::string& id) {
  ack_t ack{};
  ack.id = id, ack.client = "late";
  return encode(ack);
}

TEST(LastAcks, AreReadThoughTheServerWasToldToEnd) {
  const test::TemporaryFolder folder;
  std::vector<ServedModel> models = read_served_models({test::generic_model()});
  const Nursery nursery{worker_of(models, 2000)};
  const Hub hub(0);
  ServiceOptions options;
  options.url = "tcpq://127.0.0.1:" + std::to_string(hub.port());
  options.journal = folder.path() + "/journal";
  std::atomic<bool> stop{false};
  std::thread server([&] { serve(nursery, identities(models), options, stop); });
  Link link(options.url);
  bool replied = false;
  link.subscribe("GENIO_REPLY.late",
                 [&](const std::string&, const void*, size_t) { replied = true; });
  ASSERT_TRUE(Client(options.url).status(120));
  link.publish("GENIO_REQUEST", encode(answered_at_once("a")));
  for (int k = 0; k < 1200 && !replied; ++k) link.wait(100);
  EXPECT_TRUE(replied);
  // The last one stands behind others.
  for (int k = 0; k < 20; ++k) link.publish("GENIO_ACK", ack_of("other-" + std::to_string(k)));
  link.publish("GENIO_ACK", ack_of("a"));
  stop = true;
  server.join();
  EXPECT_EQ(Journal(options.journal).counts().delivered, 1);
}

}  // namespace
}  // namespace genio
