#include "bench/figures/service/server_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>

#include "forward/base/process_memory.hpp"
#include "server/hub/hub.hpp"
#include "server/link/tcp_address.hpp"
#include "server/service.hpp"

namespace genio::bench {
namespace {

constexpr std::chrono::seconds last_flush{3};

/// Serves until the other end of the socket is closed.
void be_a_server(std::vector<ServedModel>& models, const ServerSetup& setup, int socket) {
  const Nursery nursery(worker_of(models, 2000));
  std::optional<Hub> hub;
  if (const uint16_t port = local_tcpq_port(setup.url)) hub.emplace(port);
  ServiceOptions options;
  options.url = setup.url, options.journal = setup.journal;
  if (hub) {
    options.hub = [&] { return hub->counts(); };
    options.connected_from = [&](uint16_t port) { hub->favour(port); };
  }
  options.workers.count = setup.workers;
  options.limits.waiting = 1000;
  std::ofstream computed(setup.computed, std::ios::app);
  options.computed = [&](const std::string& id) {
    if (!setup.computed.empty()) computed << fmt::format("{} {}\n", now_us(), id) << std::flush;
  };
  std::atomic<bool> stop{false};
  std::thread watching([&] {
    char byte = 0;
    while (read(socket, &byte, 1) > 0) {
    }
    stop = true;
  });
  serve(nursery, identities(models), options, stop);
  if (hub) hub->flush(last_flush);
  watching.join();
}

std::vector<pid_t> children_of(pid_t pid) {
  std::vector<pid_t> children;
  std::ifstream in(fmt::format("/proc/{0}/task/{0}/children", pid));
  for (pid_t child; in >> child;) children.push_back(child);
  return children;
}

}  // namespace

ServerProcess::ServerProcess(std::vector<ServedModel>& models, ServerSetup setup)
    : setup_(std::move(setup)) {
  if (setup_.url.empty()) setup_.url = fmt::format("tcpq://127.0.0.1:{}", Hub(0).port());
  nursery_ = std::make_unique<Nursery>(
      [&models, s = setup_](int socket) { be_a_server(models, s, socket); });
}

ServerProcess::~ServerProcess() {
  if (server_.pid == 0) return;
  close(server_.socket);
  wait_for(NurseryEvent::Kind::ended);
}

void ServerProcess::wait_for(NurseryEvent::Kind kind) {
  constexpr int longest_ms = 60000;
  for (;;) {
    pollfd polled{nursery_->descriptor(), POLLIN, 0};
    if (poll(&polled, 1, longest_ms) == 0) throw std::runtime_error("a server does not react");
    for (const NurseryEvent& event : nursery_->events()) {
      if (event.kind == NurseryEvent::Kind::not_born)
        throw std::runtime_error("no process is left for a server");
      if (event.kind == NurseryEvent::Kind::born) server_ = event;
      if (event.kind == kind) return;
    }
  }
}

void ServerProcess::start() {
  nursery_->bear();
  wait_for(NurseryEvent::Kind::born);
}

void ServerProcess::kill() {
  nursery_->kill(server_.pid);
  wait_for(NurseryEvent::Kind::ended);
  close(server_.socket);
  server_ = {};
}

double ServerProcess::peak_mb() const {
  const size_t peak = peak_memory_of(server_.pid);
  if (peak == 0) throw std::runtime_error("the memory of a server cannot be read");
  return 1e-6 * double(peak);
}

std::vector<pid_t> ServerProcess::workers() const {
  std::vector<pid_t> all;
  for (pid_t nursery : children_of(server_.pid))
    for (pid_t worker : children_of(nursery)) all.push_back(worker);
  return all;
}

}  // namespace genio::bench
