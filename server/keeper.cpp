#include "server/keeper.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>

namespace genio {
namespace {

constexpr std::chrono::seconds prune_period{60}, prune_again{1};

template <class T>
void append_all(std::vector<T>& to, std::vector<T>&& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

Keeper::Keeper(const std::string& path, std::function<void(const std::string&)> failed)
    : journal_(std::make_unique<Journal>(path)),
      view_(std::make_unique<JournalView>(path)),
      failed_(std::move(failed)),
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
  append_all(waiting_.records, std::move(outgoing.records));
  append_all(waiting_.messages, std::move(outgoing.messages));
  changed_.notify_all();
}

KeptBatch Keeper::collect() {
  uint64_t count = 0;
  [[maybe_unused]] const auto n = read(done_signal_, &count, sizeof count);
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, {});
}

void Keeper::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.empty() && !busy_; });
}

void Keeper::work() {
  auto next_prune = std::chrono::steady_clock::now() + prune_period;
  for (std::unique_lock lock(mutex_);;) {
    changed_.wait_until(lock, next_prune, [&] { return stop_ || !waiting_.empty(); });
    if (!waiting_.empty()) {
      Outgoing outgoing = std::exchange(waiting_, {});
      busy_ = true;
      lock.unlock();
      write(std::move(outgoing));
      lock.lock();
      busy_ = false;
      changed_.notify_all();
    } else if (stop_) {
      return;
    }
    if (std::chrono::steady_clock::now() < next_prune) continue;
    lock.unlock();
    bool more = false;
    try {
      more = journal_->prune(now_us()).more;
    } catch (const JournalError& e) {
      if (failed_) failed_(e.what());
    }
    next_prune = std::chrono::steady_clock::now() + (more ? prune_again : prune_period);
    lock.lock();
  }
}

void Keeper::write(Outgoing outgoing) {
  std::vector<Unkept> unkept;
  if (!outgoing.records.empty()) unkept = write_records(*journal_, outgoing.records, now_us());
  std::set<std::string> ids;
  for (const Unkept& u : unkept) ids.insert(u.id);
  std::erase_if(outgoing.messages,
                [&](const OutgoingMessage& m) { return ids.contains(m.acknowledges); });
  {
    const std::lock_guard lock(mutex_);
    append_all(done_.messages, std::move(outgoing.messages));
    append_all(done_.unkept, std::move(unkept));
  }
  const uint64_t one = 1;
  [[maybe_unused]] const auto n = ::write(done_signal_, &one, sizeof one);
}

}  // namespace genio
