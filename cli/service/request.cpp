#include "cli/service/request.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>

#include "cli/option_sets/measured_options.hpp"
#include "cli/result_json.hpp"
#include "cli/service/request_message.hpp"
#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/prior/prior_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "report/answers/answer_report.hpp"
#include "report/answers/answer_table.hpp"
#include "runs/frames/frame.hpp"
#include "runs/results/answer_record.hpp"
#include "server/answer/message_place.hpp"
#include "server/client.hpp"

namespace genio::cli {
namespace {

struct RequestOptions {
  MeasuredOptions measured;
  std::string url, model = default_model(), prior, out, cancel_id, client, key;
  double timeout_s = 120, deadline_s = 0;
  int starts = 0;
  bool unregistered = false, json = false;
};

/// The frames that are asked about, and what all requests have alike.
struct AskedShapes {
  std::vector<ContourFrame> frames;
  double noise = 0;                              ///< [m]
  std::optional<RegistrationRecord> registered;  ///< none: that is the server's to do
  shape_request_t alike{};
};

std::string sent_prior(const std::string& path) {
  std::string text = prior_text(path);
  if (text.size() > size_t(max_string_length))
    throw InputError(fmt::format("--prior {}: has {} bytes; expected at most {}", path, text.size(),
                                 max_string_length));
  return text;
}

SharedKey key_of(const RequestOptions& o) {
  return o.key.empty() ? SharedKey{} : read_key_file(o.key);
}

/// What is told when nobody answered, with what the messages that came hint at.
std::runtime_error silence(const std::string& what, const Client& client) {
  const std::string doubt = client.doubt();
  return std::runtime_error(doubt.empty() ? what : fmt::format("{} ({})", what, doubt));
}

/// `model` gives the one to register with, where that is done here.
AskedShapes asked_shapes(const RequestOptions& o, const std::function<const Model&()>& model) {
  AskedShapes asked;
  asked.alike.deadline_s = o.deadline_s, asked.alike.starts = o.starts;
  asked.alike.bilateral = -1;
  if (!o.prior.empty()) asked.alike.prior = sent_prior(o.prior);
  if (o.unregistered) {
    Unregistered u = read_unregistered(o.measured, print_line);
    put_palate(u.palate, asked.alike);
    asked.frames = std::move(u.frames), asked.noise = u.noise;
    return asked;
  }
  MeasuredOptions as_seen = o.measured;
  as_seen.as_seen = true;
  Measured m = read_measured(as_seen, model, print_line);
  if (m.head_pose) {
    asked.alike.frame = "placed";
    put_place({m.transform.value_or(Similarity()), *m.head_pose}, asked.alike);
  }
  asked.frames = std::move(m.frames), asked.noise = m.noise;
  asked.registered = std::move(m.registration);
  return asked;
}

/// What is shown of a reply; `model` is read where it is drawn, too.
AnswerView shown(const command_reply_t& reply, const ContourFrame& frame, const AskedShapes& asked,
                 const RequestOptions& o, const std::function<const Model&()>& model) {
  AnswerView view = view_of(reply, frame);
  if (!o.out.empty() && !view.predicted.empty()) {
    const auto place = place_in_reply(reply);
    const ContourFrame laid = place ? registered(model(), frame, *place) : frame;
    view.measured = measured_points(make_target(model(), laid, asked.noise), view.others);
  }
  if (asked.registered) return with_registration(std::move(view), *asked.registered);
  return with_registration(std::move(view), reply.registration, false);
}

int run_request(const RequestOptions& o) {
  const SharedKey key = key_of(o);
  // The server computes; the model is read here only to register contours or to draw.
  std::optional<Model> read;
  const auto model = [&]() -> const Model& {
    if (!read) read.emplace(read_model(o.model));
    return *read;
  };
  const AskedShapes asked = asked_shapes(o, model);
  Client client(choose_url(o.url), o.client, key);
  if (!client.connected())
    print_line(fmt::format("nobody listens on {} yet; waiting for up to {} s", choose_url(o.url),
                           o.timeout_s));
  bool all = true;
  for (const auto& frame : asked.frames) {
    bool told = false;
    shape_request_t request = asked.alike;
    put_frame(frame, asked.noise, request);
    const auto reply = client.request(request, o.timeout_s, [&](const progress_t& p) {
      if (o.json) return;
      fmt::print(stderr, "\r{} {}: RMS {:.2f} mm   ", p.stage, p.iteration, p.rms_mm);
      told = true;
    });
    if (told) fmt::print(stderr, "\n");
    if (!reply)
      throw silence(fmt::format("no reply on {} within {} s; is 'genio serve' running?",
                                choose_url(o.url), o.timeout_s),
                    client);
    const AnswerView view = shown(*reply, frame, asked, o, model);
    if (const std::string line = registration_line(*reply); o.unregistered && !line.empty())
      print_line(line);
    all &= view.status == "converged";
    if (o.json) fmt::print("{}\n", answer_json(view, frame.number));
    else fmt::print("{}\n{}\n", view.title, to_table(view));
    std::fflush(stdout);
    if (!o.out.empty()) write_report(model(), view, frame.number, o.out, frame_name(frame.number));
  }
  return all ? done : no_answer;
}

int run_status(const RequestOptions& o) {
  Client client(choose_url(o.url), "", key_of(o));
  const auto s = client.status(o.timeout_s);
  if (!s)
    throw silence(fmt::format("no server on {} within {} s", choose_url(o.url), o.timeout_s),
                  client);
  fmt::print("{}\n", status_json(*s, o.json ? -1 : 2));
  return done;
}

/// The client's name in an id that Client made: "NAME-SESSION.NUMBER".
std::string client_of(const std::string& id) { return id.substr(0, id.rfind('-')); }

int run_cancel(const RequestOptions& o) {
  Client client(choose_url(o.url), o.client.empty() ? client_of(o.cancel_id) : o.client, key_of(o));
  if (!client.connected())
    throw std::runtime_error(fmt::format("nobody listens on {}", choose_url(o.url)));
  const auto reply = client.cancel(o.cancel_id, o.timeout_s);
  if (!reply)
    throw silence(fmt::format("no answer on {} within {} s", choose_url(o.url), o.timeout_s),
                  client);
  print_line(fmt::format("{}: {}{}{}", o.cancel_id, reply->status,
                         reply->message.empty() ? "" : ": ", reply->message));
  return reply->status == "cancelled" ? done : no_answer;
}

}  // namespace

Runner add_request(Options& options) {
  auto o = std::make_shared<RequestOptions>();
  options.add("--lcm", o->url, "LCM URL (default: LCM_DEFAULT_URL, else tcpq://127.0.0.1:7700)");
  add_measured_options(options, o->measured);
  options.flag("--unregistered", o->unregistered,
               "The server lays each frame beside the model, by --palate where that is given",
               {.not_with = {"--registered", "--force-registration", "--bite-plane", "--hyoid",
                             "--short-tendon", "--jaw-shadow", "--ignore-marks"}});
  options.add("--prior", o->prior, "What is believed before: TOML, or a CSV of EMG");
  options.add("--client", o->client, "Name under which replies come (default: one of its own)");
  options.add("--key", o->key, "Key file of a server that asks for one (see genio key)");
  options.add("--timeout-s", o->timeout_s, "How long to wait for each reply", {.positive = true});
  options.add("--deadline-s", o->deadline_s, "Time the server may compute", {.positive = true});
  options.add("--starts", o->starts, "Descents, to find other answers that fit",
              {.range = {{0, 1000}}});
  options.add("--model", o->model, "Model to register with and to show in the picture");
  options.flag("--json", o->json, "One JSON object a frame on standard output");
  options.add("--out", o->out, "Folder for pictures and numbers");
  const Options status = options.subcommand("status", "What the server is doing",
                                            {"--lcm", "--key", "--timeout-s", "--json"});
  Options cancel = options.subcommand("cancel", "Withdraw a request of the same client",
                                      {"--lcm", "--key", "--timeout-s", "--client"});
  cancel.add("id", o->cancel_id, "Id of the request", {.required = true});
  options.footer("Example: genio request --target data/examples/example_shape.csv");
  return [o, status, cancel]() -> int {
    if (status.chosen()) return run_status(*o);
    if (cancel.chosen()) return run_cancel(*o);
    return run_request(*o);
  };
}

}  // namespace genio::cli
