#pragma once
// The requester's side.

#include <functional>
#include <optional>
#include <string>

#include "server/seal/sealed_link.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// Sends requests and waits for their replies; one object a thread.
class Client {
 public:
  /// `url` as choose_url gives it; `name`: under which the replies come, 1 to 40 letters, digits,
  /// '_' or '-' (empty: one that nobody has). With a key, what it sends is sealed, and it takes
  /// nothing but what is sealed with the same key. Throws InputError when URL or name cannot be
  /// used.
  explicit Client(const std::string& url, std::string name = {}, SharedKey key = {});

  /// Sends the request (filling id, client and time where empty) and waits for its reply; asks
  /// again after 1, 2, 4 and at most 8 s, which a server computes once. Nothing when no reply came
  /// in time. Throws InputError where the request is larger than any server takes.
  std::optional<command_reply_t> request(
      shape_request_t request, double timeout_s,
      const std::function<void(const progress_t&)>& progress = {});
  /// Withdraws a request of this client's name, and gives what is answered to it: its reply, or
  /// that nothing was withdrawn. Nothing when nobody answered in time.
  std::optional<command_reply_t> cancel(const std::string& id, double timeout_s);
  /// Asks for a server's status; nothing when none came in time.
  std::optional<server_status_t> status(double timeout_s);

  const std::string& name() const { return name_; }
  /// False while nobody listens at the URL.
  bool connected() const { return link_.connected(); }
  /// What hints at a key that differs or is missing, as a clause; see SealedLink.
  std::string doubt() const { return link_.doubt(); }

 private:
  /// Publishes until reply_ is there or the time is over.
  void ask(const char* channel, const std::vector<uint8_t>& bytes, double timeout_s);

  SealedLink link_;
  std::string name_;
  std::string session_;  ///< of this object: another one of the same name has other ids
  int sent_ = 0;
  std::string waiting_for_;
  std::optional<command_reply_t> reply_;
  std::optional<server_status_t> status_;
  std::function<void(const progress_t&)> progress_;
};

}  // namespace genio
