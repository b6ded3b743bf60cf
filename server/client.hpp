#pragma once
// The requester's side.

#include <functional>
#include <optional>
#include <string>

#include "server/link.hpp"
#include "server/wire.hpp"

namespace genio {

/// Sends requests and waits for their replies; one object a thread.
class Client {
 public:
  /// `url` as choose_url gives it. Throws InputError when it cannot be used.
  explicit Client(const std::string& url);

  /// Sends the request (filling id, client and time where empty) and waits for its reply; asks
  /// again every 2 s, which a server answers once. Nothing when no reply came in time.
  std::optional<command_reply_t> request(
      shape_request_t request, double timeout_s,
      const std::function<void(const progress_t&)>& progress = {});
  /// Withdraws a request.
  void cancel(const std::string& id);
  /// The next status message of a server; nothing when none came in time.
  std::optional<server_status_t> status(double timeout_s);

  const std::string& name() const { return name_; }
  /// False while nobody listens at the URL.
  bool connected() const { return link_.connected(); }

 private:
  Link link_;
  std::string name_;
  int sent_ = 0;
  std::string waiting_for_;
  std::optional<command_reply_t> reply_;
  std::optional<server_status_t> status_;
  std::function<void(const progress_t&)> progress_;
};

}  // namespace genio
