#include "server/observe/service_manager.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "forward/base/types.hpp"
#include "tests/server/observe/manager_socket.hpp"

namespace genio {
namespace {

using test::ManagerSocket;

TEST(ServiceManager, IsToldWhenItIsReadyAndWhenItStops) {
  ManagerSocket socket;
  ServiceManager manager(socket.address(), 0);
  manager.turn(0);
  EXPECT_EQ(socket.next(), "");
  manager.ready();
  EXPECT_EQ(socket.next(), "READY=1");
  manager.say("3 running");
  EXPECT_EQ(socket.next(), "STATUS=3 running");
  manager.stopping();
  EXPECT_EQ(socket.next(), "STOPPING=1");
  manager.turn(100);
  EXPECT_EQ(socket.next(), "");
}

TEST(ServiceManager, AStatusIsOneLine) {
  ManagerSocket socket;
  ServiceManager manager(socket.address(), 0);
  manager.say("a\nSTOPPING=1");
  EXPECT_EQ(socket.next(), "STATUS=a\\x0aSTOPPING=1");
}

TEST(ServiceManager, HearsOfALoopThatTurnsAtHalfOfThePeriod) {
  ManagerSocket socket;
  ServiceManager manager(socket.address(), 10);
  int heard = 0;
  double longest = 0, last = 0;
  for (int k = 0; k <= 6000; ++k) {
    manager.turn(0.01 * k);
    if (socket.next() != "WATCHDOG=1") continue;
    ++heard;
    longest = std::max(longest, 0.01 * k - last), last = 0.01 * k;
  }
  EXPECT_EQ(heard, 13);  // at once, and after each five seconds
  EXPECT_LE(longest, 5.02);
}

TEST(ServiceManager, OneThatDoesNotReadHoldsNobodyUpAndHearsLater) {
  ManagerSocket socket;
  ServiceManager manager(socket.address(), 0);
  const Stopwatch watch;
  for (int k = 0; k < 10000; ++k) manager.say("line " + std::to_string(k));
  manager.ready();
  EXPECT_LT(watch.seconds(), 20);
  for (std::string heard = "x"; !heard.empty(); heard = socket.next()) EXPECT_NE(heard, "READY=1");
  manager.turn(0);
  EXPECT_EQ(socket.next(), "READY=1");
  EXPECT_EQ(socket.next(), "STATUS=line 9999");
  EXPECT_EQ(socket.next(), "");
}

TEST(ServiceManager, TheEndIsToldToOneThatReadsSlowly) {
  ManagerSocket socket;
  ServiceManager manager(socket.address(), 0);
  for (int k = 0; k < 10000; ++k) manager.say("line " + std::to_string(k));
  std::string last;
  std::thread reading([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (const Stopwatch watch; watch.seconds() < 20 && last != "STOPPING=1";) {
      const std::string next = socket.next();
      if (!next.empty()) last = next;
    }
  });
  manager.stopping();  // no turn follows
  reading.join();
  EXPECT_EQ(last, "STOPPING=1");
}

TEST(ServiceManager, OneThatIsGoneIsNoHarm) {
  auto socket = std::make_unique<ManagerSocket>();
  ServiceManager manager(socket->address(), 1);
  socket.reset();
  manager.ready(), manager.say("x"), manager.turn(5), manager.stopping();
}

/// While it lives, the variables are set, or not set where they are empty.
class NotifyVariables {
 public:
  NotifyVariables(const std::string& address, const std::string& period,
                  const std::string& process) {
    set("NOTIFY_SOCKET", address), set("WATCHDOG_USEC", period), set("WATCHDOG_PID", process);
  }
  ~NotifyVariables() {
    set("NOTIFY_SOCKET", ""), set("WATCHDOG_USEC", ""), set("WATCHDOG_PID", "");
  }
  NotifyVariables(const NotifyVariables&) = delete;
  NotifyVariables& operator=(const NotifyVariables&) = delete;

 private:
  static void set(const char* name, const std::string& value) {
    if (value.empty()) unsetenv(name);
    else setenv(name, value.c_str(), 1);
  }
};

double watchdog_of(const std::string& period, const std::string& process) {
  const NotifyVariables set("@genio-test-nobody", period, process);
  return ServiceManager::from_environment().watchdog_s();
}

TEST(ServiceManager, TakesWhatItsEnvironmentSays) {
  const std::string me = std::to_string(getpid()), other = std::to_string(getpid() + 1);
  EXPECT_EQ(watchdog_of("30000000", ""), 30);
  EXPECT_EQ(watchdog_of("500000", me), 0.5);
  EXPECT_EQ(watchdog_of("30000000", other), 0);
  EXPECT_EQ(watchdog_of("", ""), 0);
  ManagerSocket socket;
  const NotifyVariables set(socket.address(), "", "");
  ServiceManager manager = ServiceManager::from_environment();
  manager.ready();
  EXPECT_EQ(socket.next(), "READY=1");
}

TEST(ServiceManager, LeavesNothingInTheEnvironmentForOthers) {
  const NotifyVariables set("@genio-test-nobody", "1", "1");
  ServiceManager::from_environment();
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
    EXPECT_EQ(std::getenv(name), nullptr) << name;
}

TEST(ServiceManager, WithoutOneNobodyIsTold) {
  const NotifyVariables none("", "30000000", "");
  ServiceManager manager = ServiceManager::from_environment();
  EXPECT_EQ(manager.watchdog_s(), 0);
  manager.ready(), manager.say("x"), manager.turn(0), manager.stopping();
}

TEST(ServiceManager, VariablesThatMeanNothingAreNamed) {
  const std::array<std::array<std::string, 3>, 6> cases = {{{"nowhere", "", ""},
                                                            {"@", "", ""},
                                                            {"vsock:2:1", "", ""},
                                                            {"/" + std::string(200, 'x'), "", ""},
                                                            {"@genio-test-nobody", "soon", ""},
                                                            {"@genio-test-nobody", "-1", ""}}};
  for (const auto& [address, period, process] : cases) {
    const NotifyVariables set(address, period, process);
    try {
      ServiceManager::from_environment();
      ADD_FAILURE() << address << ' ' << period;
    } catch (const InputError& e) {
      EXPECT_TRUE(
          std::string(e.what()).starts_with(period.empty() ? "NOTIFY_SOCKET=" : "WATCHDOG_USEC="));
    }
  }
}

}  // namespace
}  // namespace genio
