#include "server/workers/pool.hpp"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "forward/base/process_memory.hpp"
#include "server/wire/body.hpp"
#include "server/workers/worker_side.hpp"

namespace genio {
namespace {

constexpr double watch_period = 0.5;  // [s]
constexpr double short_life = 10;     // of a worker that is not replaced at once [s]
constexpr double again_after = 1;     // after a birth that failed [s]

void listen_to(int epoll, int descriptor, pid_t pid, uint32_t events, int how) {
  epoll_event event{};
  event.events = events, event.data.u64 = uint64_t(pid);
  epoll_ctl(epoll, how, descriptor, &event);
}

/// What a process has of its own [MB]; 0 where it is gone.
double own_memory_mb(pid_t pid) {
  const ProcessMemory m = memory_of(pid);
  return 1e-6 * (double(m.resident) - double(m.shared));
}

std::string end_of_process(int status, const WorkerLimits& limits) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_without_memory)
    return fmt::format("it found no memory beyond {:.0f} MB", limits.memory_mb);
  if (WIFEXITED(status)) return fmt::format("exit status {}", WEXITSTATUS(status));
  return fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
}

}  // namespace

WorkerPool::WorkerPool(const Nursery& nursery, const WorkerLimits& limits)
    : nursery_(nursery), limits_(limits), epoll_(epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_ < 0) throw std::runtime_error("no descriptor is left for workers");
  listen_to(epoll_, nursery_.descriptor(), 0, EPOLLIN, EPOLL_CTL_ADD);
  bear(0);
}

WorkerPool::~WorkerPool() {
  for (const auto& [pid, worker] : workers_) nursery_.kill(pid), close(worker.socket);
  close(epoll_);
}

void WorkerPool::bear(double now) {
  if (now < bear_from_) return;
  for (; expected_ + alive() < limits_.count; ++expected_) nursery_.bear();
}

bool WorkerPool::idle() const {
  return std::any_of(workers_.begin(), workers_.end(), [](const auto& w) {
    return w.second.id.empty() && w.second.condemned.empty();
  });
}

void WorkerPool::start(const Assignment& a, double now) {
  for (auto& [pid, worker] : workers_)
    if (worker.id.empty() && worker.condemned.empty()) {
      worker.id = a.id, worker.heard = worker.watched = now;
      return send(pid, worker,
                  {WorkerWord::compute, BodyWriter()
                                            .add(int64_t(a.model))
                                            .add(a.deadline_s)
                                            .add(a.request)
                                            .add(a.start)
                                            .take()});
    }
}

void WorkerPool::withdraw(const std::string& id) {
  for (auto& [pid, worker] : workers_)
    if (worker.id == id) send(pid, worker, {WorkerWord::withdraw, {}});
}

void WorkerPool::send(pid_t pid, Worker& worker, const WorkerMessage& message) {
  const auto bytes = packed(message);
  worker.leaving.insert(worker.leaving.end(), bytes.begin(), bytes.end());
  flush(pid, worker);
}

void WorkerPool::flush(pid_t pid, Worker& worker) {
  auto& bytes = worker.leaving;
  const bool waited = !bytes.empty();
  while (!bytes.empty()) {
    const auto n = ::send(worker.socket, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;  // full, or the worker is gone, of which the nursery tells
    bytes.erase(bytes.begin(), bytes.begin() + n);
  }
  if (waited)
    listen_to(epoll_, worker.socket, pid, bytes.empty() ? EPOLLIN : EPOLLIN | EPOLLOUT,
              EPOLL_CTL_MOD);
}

void WorkerPool::condemn(pid_t pid, Worker& worker, const std::string& why) {
  if (!worker.condemned.empty()) return;
  worker.condemned = why;
  nursery_.kill(pid);
}

void WorkerPool::take(Worker& worker, const WorkerMessage& message,
                      std::vector<WorkerEvent>& events) {
  using Kind = WorkerEvent::Kind;
  const auto decoded = [](const std::vector<uint8_t>& bytes) {
    std::string why;
    auto reply = decode_checked<command_reply_t>(bytes.data(), bytes.size(), why);
    if (!reply) throw std::runtime_error("a worker's reply is none: " + why);
    return std::move(*reply);
  };
  BodyReader body(message.body);
  switch (message.word) {
    case WorkerWord::progress: {
      const int iteration = int(body.integer());
      events.push_back({Kind::progress, worker.id, iteration, body.number()});
      break;
    }
    case WorkerWord::improved:
      events.push_back({Kind::improved, worker.id, 0, 0, decoded(message.body)});
      break;
    case WorkerWord::answer: {
      auto reply = decoded(body.block());
      events.push_back({Kind::answer, worker.id, 0, 0, std::move(reply), body.block()});
      worker.id.clear();
      break;
    }
    default:
      break;
  }
}

void WorkerPool::hear(pid_t pid, Worker& worker, double now, std::vector<WorkerEvent>& events) {
  uint8_t room[1 << 16];
  for (;;) {
    const auto n = recv(worker.socket, room, sizeof room, MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      // A worker that is gone would wake the service until the nursery tells of its end.
      if (n == 0) epoll_ctl(epoll_, EPOLL_CTL_DEL, worker.socket, nullptr);
      break;
    }
    worker.heard = now;
    worker.assembler.add(room, size_t(n));
  }
  try {
    while (!worker.id.empty()) {
      const auto message = worker.assembler.next();
      if (!message) break;
      take(worker, *message, events);
    }
  } catch (const std::runtime_error& e) {
    condemn(pid, worker, e.what());
  }
}

void WorkerPool::meet(const NurseryEvent& event, double now, std::vector<WorkerEvent>& events) {
  if (event.kind == NurseryEvent::Kind::ended) {
    const auto at = workers_.find(event.pid);
    if (at == workers_.end()) return;
    Worker& worker = at->second;
    // What it said before its end counts.
    hear(event.pid, worker, now, events);
    const std::string why =
        worker.condemned.empty() ? end_of_process(event.status, limits_) : worker.condemned;
    const bool idle = worker.id.empty();
    const auto kind = idle ? WorkerEvent::Kind::idle_lost : WorkerEvent::Kind::lost;
    events.push_back({kind, worker.id, 0, 0, {}, {}, why});
    if (idle && now - worker.born < short_life) bear_from_ = now + again_after;
    close(worker.socket);
    workers_.erase(at);
    ++replaced_;
    return;
  }
  --expected_;
  // Where this process has no descriptor left, the worker's is lost.
  if (event.kind == NurseryEvent::Kind::born && event.socket < 0) nursery_.kill(event.pid);
  if (event.kind == NurseryEvent::Kind::not_born || event.socket < 0) {
    bear_from_ = now + again_after;
    return;
  }
  Worker& worker = workers_[event.pid];
  worker.inherited_mb = own_memory_mb(event.pid);
  worker.socket = event.socket, worker.born = worker.heard = worker.watched = now;
  listen_to(epoll_, worker.socket, event.pid, EPOLLIN, EPOLL_CTL_ADD);
}

void WorkerPool::watch(pid_t pid, Worker& worker, double now) {
  if (worker.id.empty() || now - worker.watched < watch_period) return;
  worker.watched = now;
  if (now - worker.heard > limits_.silence_s)
    return condemn(pid, worker, fmt::format("no sign of life for {:.0f} s", limits_.silence_s));
  if (own_memory_mb(pid) - worker.inherited_mb > limits_.memory_mb)
    condemn(pid, worker, fmt::format("it took more than {:.0f} MB", limits_.memory_mb));
}

std::vector<WorkerEvent> WorkerPool::events(double now) {
  std::vector<WorkerEvent> events;
  for (const NurseryEvent& event : nursery_.events()) meet(event, now, events);
  for (auto& [pid, worker] : workers_) {
    flush(pid, worker);
    hear(pid, worker, now, events);
    watch(pid, worker, now);
  }
  bear(now);
  return events;
}

}  // namespace genio
