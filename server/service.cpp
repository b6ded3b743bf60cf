#include "server/service.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <deque>
#include <memory>
#include <set>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/answer_request.hpp"
#include "server/dispatch/dispatcher.hpp"
#include "server/journalled.hpp"
#include "server/sealed_link.hpp"

namespace genio {
namespace {

constexpr double status_period = 1;                   // [s]
constexpr double prune_period = 60, prune_again = 1;  // [s]
constexpr int turn_ms = 20;                           // how exactly deadlines hold

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

void compute(const Model& model, const ServiceOptions& options, RequestWorker& worker,
             Dispatcher& dispatcher) {
  while (const auto next = dispatcher.next()) {
    const std::string& id = next->request.id;
    const Stopwatch watch;
    RequestHooks hooks;
    hooks.progress = [&](int iteration, double rms) {
      dispatcher.report_progress(id, iteration, rms);
    };
    hooks.improved = [&](command_reply_t so_far) { dispatcher.keep_best(id, std::move(so_far)); };
    hooks.cancelled = [&] { return dispatcher.withdrawn(id); };
    const command_reply_t reply =
        answer_request(model, next->request, next->deadline_s, worker, hooks);
    if (options.log)
      options.log(fmt::format("{}: {} {} rms {:.3f} mm in {:.2f} s", id, reply.status,
                              reply.verdict, reply.rms_mm, reply.wall_s));
    dispatcher.finish(id, reply, watch.seconds());
  }
}

OutgoingMessage status_message(const Dispatcher& dispatcher, const Model& model,
                               const SealDrops& dropped, double uptime) {
  server_status_t s = dispatcher.counts();
  s.utime = now_us(), s.version = GENIO_VERSION, s.uptime_s = uptime;
  s.unsigned_dropped = dropped.unsealed, s.forged_dropped = dropped.forged;
  s.stale_dropped = dropped.stale;
  s.model = {model.name}, s.model_hash = {""}, s.model_count = 1;
  return {"GENIO_STATUS", encode(s)};
}

/// Publishes from the front until one cannot be sent; the rest stays.
void publish(SealedLink& link, std::deque<OutgoingMessage>& messages) {
  while (!messages.empty() && link.publish(messages.front().channel, messages.front().bytes))
    messages.pop_front();
}

/// True where there is more to prune. What cannot be pruned now is pruned later.
bool prune(Journal& journal, const ServiceOptions& options) {
  try {
    return journal.prune(now_us()).more;
  } catch (const JournalError& e) {
    if (options.log) options.log(std::string("journal: ") + e.what());
    return false;
  }
}

}  // namespace

void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop) {
  const WakeUp wake;
  std::unique_ptr<Journal> journal;
  JournalLookup lookup;
  if (!options.journal.empty()) {
    journal = std::make_unique<Journal>(options.journal);
    lookup.find = [&](const std::string& id) { return known_request(*journal, id); };
  }
  Dispatcher dispatcher(
      options.limits, [&] { wake.ring(); }, lookup);
  if (journal)
    for (const JournalEntry& entry : journal->unanswered())
      dispatcher.resume(accepted_record(entry), entry.tries);
  RequestWorker worker(model);
  SealedLink link(options.url, options.key);
  link.ask_for_key_on({"GENIO_REQUEST", "GENIO_CANCEL"});
  bool status_asked = true;
  link.subscribe("GENIO_REQUEST", [&](const std::string&, const void* data, size_t size) {
    dispatcher.receive_request(data, size, now_us());
  });
  link.subscribe("GENIO_CANCEL", [&](const std::string&, const void* data, size_t size) {
    dispatcher.receive_cancel(data, size);
  });
  link.subscribe("GENIO_ACK", [&](const std::string&, const void* data, size_t size) {
    dispatcher.receive_ack(data, size);
  });
  link.subscribe("GENIO_ASK_STATUS",
                 [&](const std::string&, const void*, size_t) { status_asked = true; });
  std::thread computing([&] { compute(model, options, worker, dispatcher); });
  const Stopwatch uptime;
  double next_status = 0, next_prune = prune_period;
  std::deque<OutgoingMessage> leaving;
  const auto collect = [&] {
    Outgoing outgoing = dispatcher.take_outgoing();
    std::set<std::string> unkept;
    if (journal && !outgoing.records.empty())
      for (const Unkept& u : write_records(*journal, outgoing.records, now_us()))
        if (unkept.insert(u.id).second) dispatcher.drop(u.id, u.reason);
    for (OutgoingMessage& message : outgoing.messages)
      if (!unkept.contains(message.acknowledges)) leaving.push_back(std::move(message));
  };
  while (!stop) {
    const bool up = link.wait(turn_ms, std::array{wake.descriptor()});
    wake.clear();
    dispatcher.pass_deadlines(now_us());
    collect();
    if (status_asked || uptime.seconds() >= next_status) {
      status_asked = false, next_status = uptime.seconds() + status_period;
      leaving.push_back(status_message(dispatcher, model, link.dropped(), uptime.seconds()));
    }
    if (up) publish(link, leaving);
    if (journal && uptime.seconds() >= next_prune) {
      next_prune = uptime.seconds() + (prune(*journal, options) ? prune_again : prune_period);
    }
  }
  dispatcher.close();
  computing.join();
  dispatcher.refuse_waiting();
  collect();
  publish(link, leaving);
}

}  // namespace genio
