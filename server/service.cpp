#include "server/service.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "server/link.hpp"

namespace genio {
namespace {

constexpr auto status_period = std::chrono::seconds(2);

bool usable_name(const std::string& s) {
  return !s.empty() && s.size() <= 40 && std::all_of(s.begin(), s.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

/// What passes between the I/O thread and the computing thread.
struct Desk {
  std::mutex mutex;
  std::condition_variable work;
  std::deque<shape_request_t> queue;
  std::deque<std::pair<std::string, std::vector<uint8_t>>> outbox;  // channel, bytes
  std::map<std::string, command_reply_t> done;                      // by id
  std::deque<std::string> done_order;
  std::map<std::string, std::vector<std::string>> clients;  // waiting, by id
  std::string running;
  std::map<std::string, bool> cancelled;
  bool closing = false;
  int64_t received = 0, replied = 0, refused = 0;
  int wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  ~Desk() { close(wake); }

  void send(const std::string& channel, std::vector<uint8_t> bytes) {  // with the mutex held
    outbox.emplace_back(channel, std::move(bytes));
    const uint64_t one = 1;
    [[maybe_unused]] const auto n = write(wake, &one, sizeof one);
  }
  void reply_to(const std::string& client, command_reply_t reply) {
    reply.utime = now_us();
    send("GENIO_REPLY." + client, encode(reply));
    ++replied;
  }
};

command_reply_t refusal(const std::string& id, const std::string& message) {
  command_reply_t r{};
  r.id = id, r.status = "failed", r.verdict = "none", r.message = message;
  return r;
}

void compute(const Model& model, const ServiceOptions& options, Desk& desk) {
  RequestWorker worker(model);
  for (;;) {
    shape_request_t request;
    {
      std::unique_lock lock(desk.mutex);
      desk.running.clear();
      desk.work.wait(lock, [&] { return desk.closing || !desk.queue.empty(); });
      if (desk.closing) return;
      request = std::move(desk.queue.front());
      desk.queue.pop_front();
      desk.running = request.id;
    }
    const auto cancelled = [&] {
      const std::lock_guard lock(desk.mutex);
      return desk.closing || desk.cancelled.contains(request.id);
    };
    const auto progress = [&](int iteration, double rms) {
      progress_t p{};
      p.utime = now_us(), p.id = request.id, p.stage = "running";
      p.iteration = iteration, p.rms_mm = 1e3 * rms;
      const std::lock_guard lock(desk.mutex);
      for (const auto& client : desk.clients[request.id])
        desk.send("GENIO_PROGRESS." + client, encode(p));
    };
    const command_reply_t reply = answer_request(model, request, worker, progress, cancelled);
    if (options.log)
      options.log(fmt::format("{}: {} {} rms {:.3f} mm in {:.2f} s", request.id, reply.status,
                              reply.verdict, reply.rms_mm, reply.wall_s));
    const std::lock_guard lock(desk.mutex);
    for (const auto& client : desk.clients[request.id]) desk.reply_to(client, reply);
    desk.clients.erase(request.id);
    desk.cancelled.erase(request.id);
    desk.done[request.id] = reply;
    desk.done_order.push_back(request.id);
    if (int(desk.done_order.size()) > options.remembered) {
      desk.done.erase(desk.done_order.front());
      desk.done_order.pop_front();
    }
  }
}

void receive_request(const void* data, size_t size, const ServiceOptions& options, Desk& desk) {
  std::string why;
  const auto request = decode_checked<shape_request_t>(data, size, why);
  const std::lock_guard lock(desk.mutex);
  ++desk.received;
  if (!request) {
    // Whom to tell is not known; everybody who listens for such replies is told.
    ++desk.refused;
    return desk.reply_to("undecodable", refusal("", "request cannot be read: " + why));
  }
  const std::string client = usable_name(request->client) ? request->client : "undecodable";
  const auto refuse = [&](const std::string& message) {
    ++desk.refused;
    desk.reply_to(client, refusal(request->id, message));
  };
  if (client != request->client)
    return refuse("client: expected 1 to 40 letters, digits, '_' or '-'");
  if (request->id.empty() || request->id.size() > 200)
    return refuse("id: expected 1 to 200 characters");
  if (const auto it = desk.done.find(request->id); it != desk.done.end())
    return desk.reply_to(client, it->second);
  if (const auto it = desk.clients.find(request->id); it != desk.clients.end()) {
    auto& waiting = it->second;
    if (std::find(waiting.begin(), waiting.end(), client) == waiting.end())
      waiting.push_back(client);
    return;
  }
  if (int(desk.queue.size()) >= options.queue)
    return refuse(
        fmt::format("the queue is full ({} requests wait); try again later", desk.queue.size()));
  desk.clients[request->id] = {client};
  desk.queue.push_back(*request);
  progress_t p{};
  p.utime = now_us(), p.id = request->id, p.stage = "queued";
  desk.send("GENIO_PROGRESS." + client, encode(p));
  desk.work.notify_one();
}

void receive_cancel(const void* data, size_t size, Desk& desk) {
  std::string why;
  const auto cancel = decode_checked<cancel_t>(data, size, why);
  if (!cancel) return;
  const std::lock_guard lock(desk.mutex);
  if (desk.clients.contains(cancel->id)) desk.cancelled[cancel->id] = true;
}

}  // namespace

void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop) {
  Desk desk;
  Link link(options.url);
  link.subscribe("GENIO_REQUEST", [&](const std::string&, const void* data, size_t size) {
    receive_request(data, size, options, desk);
  });
  link.subscribe("GENIO_CANCEL", [&](const std::string&, const void* data, size_t size) {
    receive_cancel(data, size, desk);
  });
  std::thread computing([&] { compute(model, options, desk); });
  const auto started = std::chrono::steady_clock::now();
  auto next_status = started;
  std::deque<std::pair<std::string, std::vector<uint8_t>>> leaving;
  while (!stop) {
    const bool up = link.wait(100, desk.wake);
    uint64_t count = 0;
    [[maybe_unused]] const auto n = read(desk.wake, &count, sizeof count);
    {
      const std::lock_guard lock(desk.mutex);
      std::move(desk.outbox.begin(), desk.outbox.end(), std::back_inserter(leaving));
      desk.outbox.clear();
      if (std::chrono::steady_clock::now() >= next_status) {
        next_status += status_period;
        server_status_t s{};
        s.utime = now_us(), s.version = GENIO_VERSION, s.model = model.name;
        s.queued = int(desk.queue.size()), s.running = desk.running.empty() ? 0 : 1;
        s.received = desk.received, s.replied = desk.replied, s.refused = desk.refused;
        s.uptime_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        leaving.emplace_back("GENIO_STATUS", encode(s));
      }
    }
    while (up && !leaving.empty() && link.publish(leaving.front().first, leaving.front().second))
      leaving.pop_front();
  }
  {
    const std::lock_guard lock(desk.mutex);
    desk.closing = true;
  }
  desk.work.notify_all();
  computing.join();
  // Every request gets a reply: those that still wait hear that nobody will work on them.
  for (const auto& request : desk.queue)
    for (const auto& client : desk.clients[request.id])
      desk.reply_to(client, refusal(request.id, "the server stopped; ask again"));
  std::move(desk.outbox.begin(), desk.outbox.end(), std::back_inserter(leaving));
  for (const auto& [channel, bytes] : leaving)
    if (!link.publish(channel, bytes)) break;
}

}  // namespace genio
