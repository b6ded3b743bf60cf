// What becomes of the requests of a dispatcher that run, and of those whose time is over.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "server/dispatch/dispatcher.hpp"

namespace genio {
namespace {

constexpr int64_t before_deadline = 2000;  // that a reply is made up [us]
constexpr double newest_counts = 0.2;      // of the usual time of a request

}  // namespace

int64_t Dispatcher::next_deadline() const {
  return deadlines_.empty() ? 0 : deadlines_.begin()->first - before_deadline;
}

void Dispatcher::pass_deadlines(int64_t now) {
  while (!deadlines_.empty() && now >= next_deadline()) {
    const std::string id = deadlines_.begin()->second;
    Entry& entry = entries_.at(id);
    give_up(id);
    const bool waited = line_.remove(id);
    answer(entry, at_deadline(id, entry.best, waited), now);
  }
}

std::optional<Assignment> Dispatcher::next(int64_t now) {
  if (closed_) return std::nullopt;
  const auto chosen = line_.next(busy_);
  if (!chosen) return std::nullopt;
  Entry& entry = entries_.at(chosen->id);
  entry.state = State::running, entry.started = now, entry.number = chosen->number;
  running_[chosen->id] = {chosen->stream};
  if (!chosen->stream.empty()) busy_.insert(chosen->stream);
  at_once_ = std::max(at_once_, running_.size());
  Assignment a{chosen->id, entry.model, encode(entry.request), 0, states_.find(chosen->stream)};
  a.deadline_s = limits_.longest_s;
  if (entry.deadline > 0)
    a.deadline_s = std::clamp(1e-6 * double(entry.deadline - now), 1e-6, limits_.longest_s);
  return a;
}

/// A computation of which nobody waits any more, if it runs.
void Dispatcher::give_up(const std::string& id) {
  const auto run = running_.find(id);
  if (run != running_.end() && !std::exchange(run->second.unwanted, true)) unwanted_.push_back(id);
}

/// What ran under that id, and does not any more.
std::optional<Dispatcher::Running> Dispatcher::end_of(const std::string& id) {
  auto run = running_.extract(id);
  if (run.empty()) return std::nullopt;
  busy_.erase(run.mapped().stream);
  std::erase(unwanted_, id);
  return std::move(run.mapped());
}

std::vector<std::string> Dispatcher::take_unwanted() { return std::exchange(unwanted_, {}); }

void Dispatcher::report_progress(const std::string& id, int iteration, double rms_mm) {
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  for (const auto& client : it->second.clients)
    outbox_.progress(client, progress_of(id, "running", iteration, 1e-3 * rms_mm));
}

void Dispatcher::keep_best(const std::string& id, command_reply_t reply) {
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  auto& best = it->second.best;
  if (!best || says_more(reply, *best)) best = std::move(reply);
}

void Dispatcher::finish(const std::string& id, command_reply_t reply, std::vector<uint8_t> state,
                        int64_t now) {
  const auto run = end_of(id);
  if (!run) return;
  if (!run->stream.empty() && !state.empty()) states_.keep(run->stream, std::move(state));
  ++tally_.computed, tally_.failed += reply.status == "failed";
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  Entry& entry = it->second;
  usual_seconds_ += newest_counts * (1e-6 * double(now - entry.started) - usual_seconds_);
  // What is cut short by a stop in good order is taken up again from the journal, or asked again.
  if (closed_ && reply.status == "cancelled" && !entry.cancelled) {
    if (!journal_) drop(id, "the server stopped; ask again");
    return;
  }
  answer(entry, std::move(reply), now);
}

void Dispatcher::lost(const std::string& id, const std::string& reason, int64_t now) {
  if (!end_of(id)) return;
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  Entry& entry = it->second;
  ++entry.tries;
  outbox_.keep(LostRecord{id});
  if (entry.cancelled)
    return answer(entry, reply_without_answer(id, "cancelled", "cancelled by the requester"), now);
  if (entry.tries < most_tries) return wait_in_line(entry);
  ++tally_.computed, ++tally_.failed;
  answer(entry,
         reply_without_answer(id, "failed",
                              fmt::format("its computation ended a worker {} times, lastly as {}",
                                          entry.tries, reason)),
         now);
}

}  // namespace genio
