#include "tests/fuzz/dispatch_script.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "forward/base/types.hpp"
#include "server/dispatch/admission.hpp"
#include "server/dispatch/dispatcher.hpp"
#include "tests/fuzz/fuzz_script.hpp"

namespace genio::test {
namespace {

constexpr std::array clients{"me", "you", "no client", ""};
constexpr std::array models{"", "child", "adult", "nobody"};
constexpr std::array streams{"", "s", "t", "no stream"};
constexpr std::array priorities{
    0, 10, -10, 3, 11, std::numeric_limits<int>::min(), -1, std::numeric_limits<int>::max()};
constexpr std::array deadlines{0.0, 0.0, 0.001, 1.0, 1e300, -1.0, 3.0, double(NAN)};
constexpr std::array statuses{"converged", "failed", "cancelled", "deadline"};

DispatchLimits few_requests() {
  return {.waiting = 3,
          .waiting_bytes = 1500,
          .remembered = 2,
          .remembered_bytes = 3000,
          .streams = 2,
          .streams_bytes = 100};
}

class DispatchPlay {
 public:
  explicit DispatchPlay(std::string_view bytes) : script_(bytes) {}

  void play() {
    while (!script_.ended()) {
      step();
      check();
    }
    // All that were accepted are computed in the end, or refused by a server that stops.
    if (closes_) dispatcher_.close();
    while (begin_next()) check();
    while (!running_.empty()) {
      finish(running_.begin()->first, "converged");
      check();
      while (begin_next()) check();
    }
    dispatcher_.refuse_rest();
    check();
    hold(owed_.empty(), "somebody who asked has no reply");
    if (computed_ == 0) throw InputError("nothing was computed");
  }

 private:
  using Asked = std::pair<std::string, std::string>;  // client, id

  std::string id() { return std::string(1, char('a' + script_.below(5))); }

  void step() {
    switch (const uint8_t what = script_.byte(); what % 16) {
      case 0:
      case 1:
      case 2:
        return ask();
      case 3:
        return cancel();
      case 4:
        return acknowledge();
      case 5:
        return raw();
      case 6:
        now_ += int64_t(1000) << script_.below(24);
        dispatcher_.pass_deadlines(now_);
        return hold(dispatcher_.next_deadline() == 0 || dispatcher_.next_deadline() > now_,
                    "a deadline has passed and is not noticed");
      case 7:
      case 8:
        begin_next();
        return;
      case 9:
      case 10:
        return finish(id(), statuses[script_.below(statuses.size())]);
      case 11:
        return lose(id());
      case 12:
        return dispatcher_.report_progress(id(), script_.byte(), 0.1 * script_.byte());
      case 13:
        return keep_best(id());
      case 14:
        return dispatcher_.drop(id(), "the disk is full");
      default:
        return what < 128 ? resume() : close();
    }
  }

  void ask() {
    shape_request_t r{};
    r.id = id(), r.client = clients[script_.below(clients.size())];
    r.model = models[script_.below(models.size())];
    r.stream = streams[script_.below(streams.size())];
    r.priority = priorities[script_.below(priorities.size())];
    r.deadline_s = deadlines[script_.below(deadlines.size())];
    const uint8_t size = script_.byte();
    r.label = std::string(size % 4, 'x'), r.prior = std::string(3 * size, '#');
    send_request(encode(r));
  }

  void send_request(const std::vector<uint8_t>& bytes) {
    std::string why;
    const auto request = decode_checked<shape_request_t>(bytes.data(), bytes.size(), why);
    const auto sender = sender_of(bytes.data(), bytes.size());
    if (request && usable_client(request->client))
      owed_.insert({request->client, request->id.substr(0, longest_id)});
    else if (!request && sender) owed_.insert({sender->client, sender->id});
    dispatcher_.receive_request(bytes.data(), bytes.size(), now_);
  }

  void cancel() {
    cancel_t c{};
    c.id = id(), c.client = clients[script_.below(clients.size())];
    const auto bytes = encode(c);
    dispatcher_.receive_cancel(bytes.data(), bytes.size(), now_);
  }

  void acknowledge() {
    ack_t a{};
    a.id = id(), a.client = clients[script_.below(clients.size())];
    const auto bytes = encode(a);
    dispatcher_.receive_ack(bytes.data(), bytes.size());
  }

  void raw() {
    const uint8_t kind = script_.byte();
    const std::string_view some = script_.take(script_.byte());
    std::vector<uint8_t> bytes;
    const int64_t hash = kind % 4 == 0   ? shape_request_t::getHash()
                         : kind % 4 == 1 ? cancel_t::getHash()
                                         : ack_t::getHash();
    for (int shift = 56; shift >= 0 && kind < 200; shift -= 8)
      bytes.push_back(uint8_t(uint64_t(hash) >> shift));
    bytes.insert(bytes.end(), some.begin(), some.end());
    if (kind % 4 == 0) send_request(bytes);
    else if (kind % 4 == 1) dispatcher_.receive_cancel(bytes.data(), bytes.size(), now_);
    else dispatcher_.receive_ack(bytes.data(), bytes.size());
  }

  bool begin_next() {
    const auto next = dispatcher_.next(now_);
    if (!next) return false;
    std::string why;
    const auto request =
        decode_checked<shape_request_t>(next->request.data(), next->request.size(), why);
    hold(request && request->id == next->id, "a worker gets something else than the request");
    hold(next->model < 2 && std::isfinite(next->deadline_s) && next->deadline_s >= 0,
         "a worker cannot compute this");
    const std::string stream =
        request->stream.empty() ? "" : request->client + " " + request->stream + char(next->model);
    for (const auto& [id, its_stream] : running_)
      hold(id != next->id && (stream.empty() || stream != its_stream),
           "something is computed twice at once");
    running_[next->id] = stream;
    return true;
  }

  /// `id` may be the key of what runs, so it is forgotten last.
  void finish(const std::string& id, const char* status) {
    command_reply_t reply{};
    reply.id = id, reply.status = status, reply.verdict = "good";
    told_unwanted_.erase(id);
    dispatcher_.finish(id, reply, std::vector<uint8_t>(script_.byte() % 128), now_);
    computed_ += running_.erase(id) > 0;
  }

  void lose(const std::string& id) {
    told_unwanted_.erase(id);
    dispatcher_.lost(id, "killed", now_);
    returned_ += running_.erase(id);
  }

  void keep_best(const std::string& id) {
    command_reply_t reply{};
    reply.id = id, reply.status = "running", reply.rms_mm = script_.byte();
    dispatcher_.keep_best(id, reply);
  }

  /// What an earlier process left, which has ids of its own.
  void resume() {
    shape_request_t r{};
    r.id = "earlier" + std::to_string(returned_++), r.client = "me";
    r.model = models[script_.below(models.size())];
    AcceptedRecord record{r.id, r.client, digest_of(r), encode(r), now_, 0, r.model, "", 0};
    if (script_.below(4) == 0) record.request.pop_back();
    owed_.insert({r.client, r.id});
    dispatcher_.resume(record, int(script_.below(4)), now_);
  }

  void close() {
    closes_ = true;
    dispatcher_.close();
  }

  void check() {
    for (const OutgoingMessage& message : dispatcher_.take_outgoing().messages) {
      std::string why;
      const std::string& channel = message.channel;
      const std::vector<uint8_t>& bytes = message.bytes;
      // Clients of earlier versions get replies of theirs.
      if (const auto reply = decode_checked<command_reply_t>(bytes.data(), bytes.size(), why))
        owed_.erase({channel.substr(channel.find('.') + 1), reply->id});
      else
        hold(channel.starts_with("GENIO_REPLY.") ||
                 decode_checked<progress_t>(bytes.data(), bytes.size(), why),
             "a message is published that nobody can read");
    }
    for (const std::string& id : dispatcher_.take_unwanted())
      hold(running_.contains(id) && told_unwanted_.insert(id).second,
           "what does not run is to be stopped, or it is told twice");
    server_status_t status{};
    dispatcher_.tell(status);
    hold(dispatcher_.running() == running_.size() && status.running == int(running_.size()),
         "something else runs than was begun");
    hold(status.queued >= 0 &&
             size_t(status.queued) <= size_t(few_requests().waiting) * 5 / 4 + returned_,
         "too many wait");
    dispatcher_.take_notes(), dispatcher_.take_drops();
  }

  FuzzScript script_;
  Dispatcher dispatcher_{few_requests(), {{"adult", "a"}, {"child", "c"}}};
  int64_t now_ = 1'700'000'000'000'000;
  std::set<Asked> owed_;                        // a reply
  std::map<std::string, std::string> running_;  // ids and their streams
  std::set<std::string> told_unwanted_;
  size_t computed_ = 0, returned_ = 0;  // returned: to the line, past its limit
  bool closes_ = false;
};

}  // namespace

void play_dispatch_script(const std::string& bytes) { DispatchPlay(bytes).play(); }

std::vector<std::string> sample_dispatch_scripts() {
  const auto scripted = [](std::initializer_list<int> bytes) {
    std::string script;
    for (const int b : bytes) script += char(b);
    return script;
  };
  // Two ask the same, one asks for more; the first waits, runs, makes progress and ends.
  return {scripted({0, 0, 0, 0,  1, 0, 0, 2,  0, 0, 1, 0, 1, 0, 0, 2, 1, 1, 0, 2, 1, 1,
                    3, 1, 7, 12, 0, 3, 4, 13, 0, 9, 9, 0, 0, 5, 7, 9, 1, 0, 0, 4, 0, 0}),
          // A worker is lost twice, a waiting request is withdrawn, a deadline passes.
          scripted({0, 0, 0, 0, 0, 0, 0, 0, 7, 11, 0,  7, 11, 0, 0, 1,  1, 0, 0, 0, 3, 1, 0, 2, 0,
                    0, 0, 0, 2, 0, 7, 3, 1, 1, 6,  12, 9, 2,  0, 0, 15, 1, 1, 0, 7, 9, 2, 0, 0})};
}

}  // namespace genio::test
