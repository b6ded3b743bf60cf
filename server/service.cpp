#include "server/service.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <deque>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/answer_request.hpp"
#include "server/link.hpp"
#include "server/request_queue.hpp"

namespace genio {
namespace {

constexpr double status_period = 2;  // [s]

/// Ends a thread's waiting for messages from another thread.
class WakeUp {
 public:
  ~WakeUp() { close(descriptor_); }
  int descriptor() const { return descriptor_; }
  void ring() const {
    const uint64_t one = 1;
    [[maybe_unused]] const auto n = write(descriptor_, &one, sizeof one);
  }
  void clear() const {
    uint64_t count = 0;
    [[maybe_unused]] const auto n = read(descriptor_, &count, sizeof count);
  }

 private:
  int descriptor_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
};

void compute(const Model& model, const ServiceOptions& options, RequestQueue& queue) {
  RequestWorker worker(model);
  while (const auto request = queue.next()) {
    const std::string& id = request->id;
    const command_reply_t reply = answer_request(
        model, *request, worker,
        [&](int iteration, double rms) { queue.report_progress(id, iteration, rms); },
        [&] { return queue.withdrawn(id); });
    if (options.log)
      options.log(fmt::format("{}: {} {} rms {:.3f} mm in {:.2f} s", id, reply.status,
                              reply.verdict, reply.rms_mm, reply.wall_s));
    queue.finish(id, reply);
  }
}

OutgoingMessage status_message(const RequestQueue& queue, const Model& model, double uptime) {
  server_status_t s = queue.counts();
  s.utime = now_us(), s.version = GENIO_VERSION, s.model = model.name, s.uptime_s = uptime;
  return {"GENIO_STATUS", encode(s)};
}

/// Publishes from the front until one cannot be sent; the rest stays.
void publish(Link& link, std::deque<OutgoingMessage>& messages) {
  while (!messages.empty() && link.publish(messages.front().channel, messages.front().bytes))
    messages.pop_front();
}

}  // namespace

void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop) {
  const WakeUp wake;
  RequestQueue queue({options.queue, options.remembered}, [&] { wake.ring(); });
  Link link(options.url);
  link.subscribe("GENIO_REQUEST", [&](const std::string&, const void* data, size_t size) {
    queue.receive_request(data, size);
  });
  link.subscribe("GENIO_CANCEL", [&](const std::string&, const void* data, size_t size) {
    queue.receive_cancel(data, size);
  });
  std::thread computing([&] { compute(model, options, queue); });
  const Stopwatch uptime;
  double next_status = 0;
  std::deque<OutgoingMessage> leaving;
  const auto collect = [&] {
    for (OutgoingMessage& message : queue.take_outgoing()) leaving.push_back(std::move(message));
  };
  while (!stop) {
    const bool up = link.wait(100, wake.descriptor());
    wake.clear();
    collect();
    if (uptime.seconds() >= next_status) {
      next_status += status_period;
      leaving.push_back(status_message(queue, model, uptime.seconds()));
    }
    if (up) publish(link, leaving);
  }
  queue.close();
  computing.join();
  queue.refuse_waiting();
  collect();
  publish(link, leaving);
}

}  // namespace genio
