#include "server/client.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "forward/base/elapsed.hpp"
#include "forward/base/types.hpp"
#include "server/dispatch/admission.hpp"

namespace genio {
namespace {

constexpr double first_pause_s = 1, longest_pause_s = 8;  // before asking again

/// When a question is to be sent again, as it or its answer may be lost.
class Patience {
 public:
  bool is_due() const { return watch_.seconds() >= ask_at_; }
  void asked() {
    ask_at_ = watch_.seconds() + pause_;
    pause_ = std::min(2 * pause_, longest_pause_s);
  }
  void ask_in(double seconds) { ask_at_ = watch_.seconds() + seconds; }
  double seconds() const { return watch_.seconds(); }

 private:
  Stopwatch watch_;
  double ask_at_ = 0, pause_ = first_pause_s;
};

std::string random_text() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

std::string unique_name() { return fmt::format("c{}-{}", getpid(), random_text()); }

}  // namespace

Client::Client(const std::string& url, std::string name, SharedKey key)
    : link_(url, std::move(key)),
      name_(name.empty() ? unique_name() : std::move(name)),
      session_(random_text()) {
  if (!usable_client(name_))
    throw InputError(
        fmt::format("client '{}': expected 1 to 40 letters, digits, '_' or '-'", name_));
  link_.subscribe("GENIO_REPLY." + name_,
                  [this](const std::string&, const void* data, size_t size) {
                    std::string why;
                    auto reply = decode_checked<command_reply_t>(data, size, why);
                    if (reply && reply->id == waiting_for_) reply_ = std::move(reply);
                  });
  link_.subscribe("GENIO_PROGRESS." + name_,
                  [this](const std::string&, const void* data, size_t size) {
                    std::string why;
                    const auto p = decode_checked<progress_t>(data, size, why);
                    if (p && p->id == waiting_for_ && progress_) progress_(*p);
                  });
  link_.subscribe("GENIO_STATUS", [this](const std::string&, const void* data, size_t size) {
    std::string why;
    status_ = decode_checked<server_status_t>(data, size, why);
  });
}

void Client::ask(const char* channel, const std::vector<uint8_t>& bytes, double timeout_s) {
  for (Patience patience; !reply_ && patience.seconds() < timeout_s;) {
    if (patience.is_due() && link_.publish(channel, bytes)) patience.asked();
    link_.wait(20);
    // A full queue, or a server that stops, is none for long.
    if (reply_ && reply_->status == "refused" && reply_->retry_after_s > 0 &&
        patience.seconds() + reply_->retry_after_s < timeout_s)
      patience.ask_in(reply_->retry_after_s), reply_.reset();
  }
}

std::optional<command_reply_t> Client::request(
    shape_request_t request, double timeout_s,
    const std::function<void(const progress_t&)>& progress) {
  request.client = name_;
  if (request.id.empty()) request.id = fmt::format("{}-{}.{}", name_, session_, ++sent_);
  request.utime = now_us();
  waiting_for_ = request.id;
  reply_.reset();
  progress_ = progress;
  const auto bytes = encode(request);
  if (bytes.size() > max_message_bytes)
    throw InputError(fmt::format("the request takes {} bytes; expected at most {}", bytes.size(),
                                 max_message_bytes));
  ask("GENIO_REQUEST", bytes, timeout_s);
  progress_ = {};
  // A refusal is none of the replies that are kept; the id may be another client's.
  if (reply_ && reply_->status != "refused") {
    ack_t ack{};
    ack.utime = now_us(), ack.id = reply_->id, ack.client = name_;
    link_.publish("GENIO_ACK", encode(ack));
  }
  return reply_;
}

std::optional<command_reply_t> Client::cancel(const std::string& id, double timeout_s) {
  cancel_t c{};
  c.utime = now_us(), c.id = id, c.client = name_;
  waiting_for_ = id;
  reply_.reset();
  ask("GENIO_CANCEL", encode(c), timeout_s);
  return reply_;
}

std::optional<server_status_t> Client::status(double timeout_s) {
  status_.reset();
  const Stopwatch watch;
  for (bool asked = false; !status_ && watch.seconds() < timeout_s;) {
    if (!asked) asked = link_.publish("GENIO_ASK_STATUS", {0});
    link_.wait(50);
  }
  return status_;
}

}  // namespace genio
