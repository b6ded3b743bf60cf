#include "server/keeper.hpp"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace genio {
namespace {

using std::chrono::steady_clock;
constexpr std::chrono::seconds prune_period{60}, prune_again{1}, write_again{1};
constexpr size_t small_record = 256;  // what one takes beside its contents [bytes]

template <class T>
void append_all(std::vector<T>& to, std::vector<T>&& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

size_t record_bytes(const Record& record) {
  const size_t id = std::visit([](const auto& r) { return r.id.size(); }, record);
  if (const auto* accepted = std::get_if<AcceptedRecord>(&record))
    return small_record + id + accepted->request.size();
  if (const auto* answered = std::get_if<AnsweredRecord>(&record))
    return small_record + id + answered->reply.size();
  return small_record + id;
}

size_t bytes_of(const std::vector<Record>& records) {
  size_t bytes = 0;
  for (const Record& record : records) bytes += record_bytes(record);
  return bytes;
}

size_t bytes_of(const std::vector<OutgoingMessage>& messages) {
  size_t bytes = 0;
  for (const OutgoingMessage& m : messages) bytes += small_record + m.bytes.size();
  return bytes;
}

size_t bytes_of(const Outgoing& outgoing) {
  return bytes_of(outgoing.records) + bytes_of(outgoing.messages);
}

/// Takes out the messages that wait for no record.
std::vector<OutgoingMessage> ready_ones(std::vector<OutgoingMessage>& messages) {
  const auto ready =
      std::stable_partition(messages.begin(), messages.end(),
                            [](const OutgoingMessage& m) { return m.passage != Passage::at_once; });
  std::vector<OutgoingMessage> taken(std::make_move_iterator(ready),
                                     std::make_move_iterator(messages.end()));
  messages.erase(ready, messages.end());
  return taken;
}

void leave_out_the_least(Outgoing& outgoing) {
  std::erase_if(outgoing.messages,
                [](const OutgoingMessage& m) { return m.passage == Passage::if_room; });
  std::erase_if(outgoing.records, [](const Record& record) {
    return std::holds_alternative<DeliveredRecord>(record);
  });
}

}  // namespace

Keeper::Keeper(const std::string& path, std::function<void(const std::string&)> failed,
               size_t most_bytes)
    : journal_(std::make_unique<Journal>(path)),
      view_(std::make_unique<JournalView>(path)),
      failed_(std::move(failed)),
      most_bytes_(most_bytes),
      done_signal_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this] { work(); }) {}

Keeper::~Keeper() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
  close(done_signal_);
}

void Keeper::hand_over(Outgoing outgoing) {
  const std::lock_guard lock(mutex_);
  append_all(done_.messages, ready_ones(outgoing.messages));
  if (held_bytes() > most_bytes_) leave_out_the_least(outgoing);
  waiting_bytes_ += bytes_of(outgoing);
  append_all(waiting_.records, std::move(outgoing.records));
  append_all(waiting_.messages, std::move(outgoing.messages));
  changed_.notify_all();
}

bool Keeper::is_behind() const {
  const std::lock_guard lock(mutex_);
  return held_bytes() > most_bytes_;
}

KeptBatch Keeper::collect() {
  uint64_t count = 0;
  [[maybe_unused]] const auto n = read(done_signal_, &count, sizeof count);
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, {});
}

std::string Keeper::finish(Time until) {
  std::unique_lock lock(mutex_);
  const auto all_done = [&] { return waiting_.empty() && !busy_ && unwritten_bytes_ == 0; };
  if (changed_.wait_until(lock, until, all_done)) return "";
  given_up_ = true;
  return fmt::format("{:.1f} kB were given up at the end, as they could not be written in time{}",
                     1e-3 * double(held_bytes()), failure_.empty() ? "" : ": " + failure_);
}

void Keeper::work() {
  Time next_prune = steady_clock::now() + prune_period, again = Time::max();
  for (std::unique_lock lock(mutex_);;) {
    changed_.wait_until(lock, std::min(next_prune, again),
                        [&] { return stop_ || !waiting_.empty(); });
    if (!given_up_ && (!waiting_.empty() || steady_clock::now() >= again)) {
      Outgoing outgoing = std::exchange(waiting_, {});
      writing_bytes_ = std::exchange(waiting_bytes_, 0);
      busy_ = true;
      lock.unlock();
      write(std::move(outgoing));
      lock.lock();
      busy_ = false;
      again = unwritten_bytes_ > 0 ? steady_clock::now() + write_again : Time::max();
      changed_.notify_all();
    } else if (stop_) {
      return;
    }
    if (steady_clock::now() < next_prune) continue;
    lock.unlock();
    prune(next_prune);
    lock.lock();
  }
}

void Keeper::prune(Time& next) {
  bool more = false;
  try {
    more = journal_->prune(now_us()).more;
  } catch (const JournalError& e) {
    if (failed_) failed_(e.what());
  }
  next = steady_clock::now() + (more ? prune_again : prune_period);
}

void Keeper::write(Outgoing outgoing) {
  std::vector<Record> records = std::exchange(put_off_, {});
  append_all(records, std::move(outgoing.records));
  RecordsWritten written;
  if (!records.empty() || journal_->unwritten_bytes() > 0)
    written = write_records(*journal_, std::move(records), now_us());
  put_off_ = std::move(written.put_off);
  std::set<std::string> ids;
  for (const Unkept& u : written.unkept) ids.insert(u.id);
  std::erase_if(outgoing.messages,
                [&](const OutgoingMessage& m) { return ids.contains(m.acknowledges); });
  append_all(withheld_, std::move(outgoing.messages));
  size_t unwritten = bytes_of(put_off_) + journal_->unwritten_bytes();
  std::vector<OutgoingMessage> published;
  if (unwritten == 0) published = std::exchange(withheld_, {});
  else unwritten += bytes_of(withheld_);
  bool fails_now = false;
  {
    const std::lock_guard lock(mutex_);
    fails_now = unwritten > 0 && unwritten_bytes_ == 0;
    writing_bytes_ = 0, unwritten_bytes_ = unwritten;
    failure_ = unwritten > 0 ? written.failure : "";
    append_all(done_.messages, std::move(published));
    append_all(done_.unkept, std::move(written.unkept));
  }
  if (fails_now && failed_) failed_(written.failure);
  const uint64_t one = 1;
  [[maybe_unused]] const auto n = ::write(done_signal_, &one, sizeof one);
}

}  // namespace genio
