#include "server/observe/observer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include "tests/runs/temporary_folder.hpp"
#include "tests/server/metrics/http_client.hpp"
#include "tests/server/observe/manager_socket.hpp"

namespace genio {
namespace {

TEST(Observer, EverybodyIsToldOfAServicesLife) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/log";
  const Descriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  test::ManagerSocket socket;
  ServiceManager manager(socket.address(), 10);
  MetricsEndpoint metrics(0);
  auto log = std::make_unique<Log>(LogForm::text, file.get());
  Observer observer({log.get(),
                     &metrics,
                     &manager,
                     [] {
                       HubCounts hub;
                       hub.accepted = 77;
                       return hub;
                     },
                     {{"url", "u"}}});
  server_status_t status{};
  status.version = "1.2.3", status.replied = 9, status.refused = 2, status.running = 1;

  observer.serving(status);
  EXPECT_EQ(socket.next(), "READY=1");
  EXPECT_EQ(socket.next(), "STATUS=1 running, 0 queued, 7 answered since the start");
  observer.turn();
  EXPECT_EQ(socket.next(), "WATCHDOG=1");
  EXPECT_NE(test::http_get(metrics.port()).find("genio_hub_accepted_total 77\n"),
            std::string::npos);
  observer.stopping();
  EXPECT_EQ(socket.next(), "STOPPING=1");
  EXPECT_EQ(socket.next(), "STATUS=finishes what runs");
  observer.status(status);
  EXPECT_EQ(socket.next(), "");
  observer.stopped(status, {1, 2, 3});

  log.reset();
  const std::string text = test::content_of(path);
  EXPECT_NE(text.find(" info serving version=1.2.3 "), text.npos) << text;
  EXPECT_NE(text.find(" info stopped finished=1 journalled=2 refused=3 "), text.npos) << text;
}

TEST(Observer, WhoHasNobodyToTellIsSilent) {
  Observer observer;
  observer.serving({}), observer.status({}), observer.turn(), observer.stopping();
  observer.stopped({}, {}), observer.write({LogKind::counts});
}

}  // namespace
}  // namespace genio
