#include "server/service.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "forward/base/elapsed.hpp"
#include "forward/base/process_memory.hpp"
#include "server/keeper.hpp"
#include "server/seal/sealed_link.hpp"
#include "server/wire/process_clock.hpp"

namespace genio {
namespace {

constexpr double status_period = 1, longest_end = 5;  // [s]
constexpr std::chrono::seconds longest_keeping{5};    // of what the journal is to have at the end
constexpr double longest_reading = 0.1;               // of acknowledgements at the end [s]
constexpr int ack_patience_ms = 30;                   // with the next one
constexpr double shortest_status = 2e-3;              // between two that are asked for
constexpr int longest_turn_ms = 100, most_messages = 8;
constexpr size_t most_undelivered = 64u << 20;  // bytes; replies are asked for again

/// Messages that are to be published, in their order.
class Departures {
 public:
  void add(OutgoingMessage message) {
    bytes_ += message.bytes.size();
    messages_.push_back(std::move(message));
    while (bytes_ > most_undelivered) drop_first();
  }
  /// Publishes from the front until one cannot be sent.
  void publish(SealedLink& link) {
    while (!messages_.empty() && link.publish(messages_.front().channel, messages_.front().bytes))
      drop_first();
  }
  /// While the connection is down: news are no news afterwards, and replies are asked for again.
  void keep_replies() {
    std::deque<OutgoingMessage> kept;
    for (OutgoingMessage& m : messages_)
      if (m.channel.starts_with("GENIO_REPLY.")) kept.push_back(std::move(m));
    messages_.clear(), bytes_ = 0;
    for (OutgoingMessage& m : kept) add(std::move(m));
  }

 private:
  void drop_first() {
    bytes_ -= messages_.front().bytes.size();
    messages_.pop_front();
  }
  std::deque<OutgoingMessage> messages_;
  size_t bytes_ = 0;
};

JournalLookup lookup_in(const Keeper* keeper) {
  if (!keeper) return {};
  return {[keeper](const std::string& id) { return keeper->find(id); }};
}

std::unique_ptr<Keeper> keeper_of(const std::string& path, Observer& observer) {
  return std::make_unique<Keeper>(path, [&observer](const std::string& reason) {
    observer.write(journal_failed_event(reason));
  });
}

/// All that belongs to the thread of the messages.
class ServiceLoop {
 public:
  ServiceLoop(const Nursery& nursery, const std::vector<ModelIdentity>& models,
              const ServiceOptions& options, Observer& observer)
      : options_(options),
        observer_(observer),
        keeper_(options.journal.empty() ? nullptr : keeper_of(options.journal, observer)),
        dispatcher_(options.limits, models, lookup_in(keeper_.get())),
        pool_(nursery, options.workers),
        link_(options.url, options.key) {
    if (keeper_) resume();
    subscribe();
    waited_for_ = {pool_.descriptor()};
    if (keeper_) waited_for_.push_back(keeper_->descriptor());
  }

  void turn() {
    bool up = link_.wait(patience_ms(), waited_for_);
    // What some messages lead to is written and published together, which costs less.
    for (int k = 1; k < most_messages && up; ++k) up = link_.wait(0);
    tell_port();
    take_from_workers();
    dispatcher_.pass_deadlines(process_us());
    for (const std::string& id : dispatcher_.take_unwanted()) pool_.withdraw(id);
    while (pool_.idle()) {
      const auto next = dispatcher_.next(process_us());
      if (!next) break;
      pool_.start(*next, uptime_.seconds());
    }
    collect();
    if (uptime_.seconds() >= due_status()) tell_status();
    if (!serving_ && heard_ && pool_.alive() > 0)
      serving_ = true, observer_.serving(status(), link_.counts());
    observer_.turn();
    if (up) departures_.publish(link_);
    else departures_.keep_replies();
  }

  void end() {
    observer_.stopping();
    const server_status_t told = status();
    dispatcher_.close();
    const Stopwatch ending;
    while (!keeper_ && dispatcher_.running() > 0 && ending.seconds() < longest_end) turn();
    dispatcher_.refuse_rest();
    collect();
    if (keeper_) finish_journal();
    departures_.publish(link_);
    const server_status_t last = status();
    observer_.stopped(last, drain_counts(told, last, bool(keeper_)));
  }

 private:
  /// Keeps what is to be kept, and who has acknowledged a reply. Nobody else is heard any more.
  void finish_journal() {
    const Keeper::Time until = std::chrono::steady_clock::now() + longest_keeping;
    std::string given_up = keeper_->finish(until);
    collect(), collect();
    departures_.publish(link_);
    read_last_acks();
    collect();
    if (given_up.empty()) given_up = keeper_->finish(until);
    if (!given_up.empty()) observer_.write(journal_failed_event(given_up));
    collect();
  }

  /// Those that have come, or are on their way.
  void read_last_acks() {
    acks_alone_ = true;
    const Stopwatch reading;
    do came_ = false, link_.wait(ack_patience_ms);
    while (came_ && reading.seconds() < longest_reading);
  }

  void tell_port() {
    const uint16_t port = link_.local_port();
    if (options_.connected_from && std::exchange(port_, port) != port)
      options_.connected_from(port);
  }

  void resume() {
    const auto unanswered = keeper_->unanswered();
    if (!unanswered.empty()) observer_.write(resumed_event(int64_t(unanswered.size())));
    for (const JournalEntry& entry : unanswered)
      dispatcher_.resume(later(accepted_record(entry), -wall_lead_us()), entry.tries, process_us());
  }

  void subscribe() {
    link_.ask_for_key_on({"GENIO_REQUEST", "GENIO_CANCEL"});
    link_.subscribe("GENIO_REQUEST", [this](const std::string&, const void* data, size_t size) {
      came_ = true;
      if (!acks_alone_) dispatcher_.receive_request(data, size, process_us());
    });
    link_.subscribe("GENIO_CANCEL", [this](const std::string&, const void* data, size_t size) {
      came_ = true;
      if (!acks_alone_) dispatcher_.receive_cancel(data, size, process_us());
    });
    link_.subscribe("GENIO_ACK", [this](const std::string&, const void* data, size_t size) {
      came_ = true;
      dispatcher_.receive_ack(data, size);
    });
    link_.subscribe("GENIO_ASK_STATUS", [this](const std::string&, const void*, size_t) {
      status_asked_ = heard_ = true;
    });
  }

  /// Until something is due.
  int patience_ms() const {
    double wait = 1e3 * (due_status() - uptime_.seconds());
    if (const int64_t deadline = dispatcher_.next_deadline(); deadline > 0)
      wait = std::min(wait, 1e-3 * double(deadline - process_us()));
    return int(std::clamp(std::ceil(wait), 0.0, double(longest_turn_ms)));
  }

  void take_from_workers() {
    using Kind = WorkerEvent::Kind;
    for (WorkerEvent& event : pool_.events(uptime_.seconds())) switch (event.kind) {
        case Kind::progress:
          dispatcher_.report_progress(event.id, event.iteration, event.rms_mm);
          break;
        case Kind::improved:
          dispatcher_.keep_best(event.id, std::move(event.reply));
          break;
        case Kind::answer:
          if (options_.computed) options_.computed(event.id);
          dispatcher_.finish(event.id, std::move(event.reply), std::move(event.state),
                             process_us());
          break;
        case Kind::idle_lost:
          observer_.write(worker_replaced_event("", event.reason));
          break;
        case Kind::lost:
          observer_.write(worker_replaced_event(event.id, event.reason));
          dispatcher_.lost(event.id, event.reason, process_us());
          break;
      }
  }

  void collect() {
    for (const ReplyNote& n : dispatcher_.take_notes())
      observer_.write(reply_event(n.client, n.reply));
    for (const DropNote& n : dispatcher_.take_drops())
      observer_.write(dropped_event(n.channel, n.bytes, n.reason));
    for (const FailedHandling& f : link_.take_failures())
      observer_.write(dropped_event(f.channel, f.bytes, "an error of the server: " + f.reason));
    Outgoing outgoing = dispatcher_.take_outgoing();
    if (!keeper_) {
      for (OutgoingMessage& m : outgoing.messages) departures_.add(std::move(m));
      return;
    }
    for (Record& record : outgoing.records)
      if (auto* const accepted = std::get_if<AcceptedRecord>(&record))
        *accepted = later(std::move(*accepted), wall_lead_us());
    if (!outgoing.empty()) keeper_->hand_over(std::move(outgoing));
    dispatcher_.hold(keeper_->is_behind());
    KeptBatch kept = keeper_->collect();
    for (OutgoingMessage& m : kept.messages) departures_.add(std::move(m));
    for (const Unkept& u : kept.unkept) dispatcher_.drop(u.id, u.reason);
  }

  /// Of many who ask at once all get the same one.
  double due_status() const {
    return status_asked_ ? std::min(next_status_, last_status_ + shortest_status) : next_status_;
  }

  void tell_status() {
    last_status_ = uptime_.seconds();
    const server_status_t s = status();
    departures_.add({"GENIO_STATUS", encode(s)});
    // Whoever hears himself is heard by others.
    if (!heard_) departures_.add({"GENIO_ASK_STATUS", {0}});
    if (uptime_.seconds() >= next_status_) {
      next_status_ = uptime_.seconds() + status_period;
      observer_.status(s, link_.counts());
    }
    status_asked_ = false;
  }

  server_status_t status() const {
    server_status_t s{};
    dispatcher_.tell(s);
    s.utime = now_us(), s.version = GENIO_VERSION, s.uptime_s = uptime_.seconds();
    s.workers = pool_.alive(), s.replaced = pool_.replaced();
    s.memory_mb = 1e-6 * double(own_memory().resident);
    s.unreadable += int64_t(link_.counts().failed_handlings);
    const SealDrops& dropped = link_.dropped();
    s.unsigned_dropped = dropped.unsealed, s.forged_dropped = dropped.forged;
    s.stale_dropped = dropped.stale;
    if (!options_.hub) return s;
    const HubCounts hub = options_.hub();
    for (uint64_t drops : hub.drops) s.hub_dropped += int64_t(drops);
    s.hub_connections = int64_t(hub.connections);
    return s;
  }

  const ServiceOptions& options_;
  Observer& observer_;
  const Stopwatch uptime_;
  std::unique_ptr<Keeper> keeper_;
  Dispatcher dispatcher_;
  WorkerPool pool_;
  SealedLink link_;
  std::vector<int> waited_for_;
  Departures departures_;
  double next_status_ = 0, last_status_ = -1;
  uint16_t port_ = 0;
  bool status_asked_ = false, heard_ = false, serving_ = false;
  bool came_ = false;        // a message, since it was last asked
  bool acks_alone_ = false;  // are heard at the end
};

}  // namespace

void serve(const Nursery& nursery, const std::vector<ModelIdentity>& models,
           const ServiceOptions& options, const std::atomic<bool>& stop) {
  Observer nobody;
  ServiceLoop loop(nursery, models, options, options.observer ? *options.observer : nobody);
  while (!stop) loop.turn();
  loop.end();
}

}  // namespace genio
