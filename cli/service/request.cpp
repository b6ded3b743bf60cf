#include "cli/service/request.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cli/option_sets/measured_options.hpp"
#include "cli/result_json.hpp"
#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "report/answers/answer_report.hpp"
#include "report/answers/answer_table.hpp"
#include "runs/frames/frame.hpp"
#include "runs/results/answer_record.hpp"
#include "server/client.hpp"

namespace genio::cli {
namespace {

struct RequestOptions {
  MeasuredOptions measured;
  std::string url, model = default_model(), out, cancel_id, client, key;
  double timeout_s = 120, deadline_s = 0;
  int starts = 0;
  bool json = false;
};

shape_request_t request_of(const ContourFrame& frame, double noise, const RequestOptions& o) {
  shape_request_t r{};
  for (const auto& p : frame.points) {
    r.x_mm.push_back(1e3 * p.position[0]);
    r.y_mm.push_back(1e3 * p.position[1]);
    r.z_mm.push_back(1e3 * p.position[2]);
    r.sigma_mm.push_back(1e3 * p.sigma);
    r.kind.push_back(p.kind);
  }
  r.point_count = int(frame.points.size());
  r.default_sigma_mm = 1e3 * noise;
  r.deadline_s = o.deadline_s;
  r.time_s = frame.time_s, r.label = frame.label;
  r.starts = o.starts;
  r.bilateral = -1;
  return r;
}

SharedKey key_of(const RequestOptions& o) {
  return o.key.empty() ? SharedKey{} : read_key_file(o.key);
}

/// What is told when nobody answered, with what the messages that came hint at.
std::runtime_error silence(const std::string& what, const Client& client) {
  const std::string doubt = client.doubt();
  return std::runtime_error(doubt.empty() ? what : fmt::format("{} ({})", what, doubt));
}

/// Names that stand joined by '+'.
std::vector<std::string> parted(const std::string& joined) {
  std::vector<std::string> names(1);
  for (char c : joined)
    if (c == '+') names.emplace_back();
    else names.back() += c;
  return names;
}

AnswerView view_of(const command_reply_t& r, const ContourFrame& frame) {
  AnswerView v;
  tell_frame(frame, v);
  v.status = r.status, v.message = r.message, v.verdict = r.verdict;
  for (size_t i = 0; i < r.muscle.size(); ++i)
    v.muscles.push_back({.name = r.muscle[i],
                         .best = r.force_N[i],
                         .maximum = r.max_force_N[i],
                         .acts = r.acts[i],
                         .median = r.median_N[i],
                         .mean = r.mean_N[i],
                         .sd = r.sd_N[i],
                         .low = r.low_N[i],
                         .high = r.high_N[i],
                         .information_bits = r.information_bits[i]});
  for (const auto& group : r.unidentified) v.unidentified.push_back(parted(group));
  v.trade_offs.resize(r.unidentified.size());
  for (size_t k = 0; k < r.trade_group.size(); ++k)
    if (const auto group = size_t(r.trade_group[k]); group < v.trade_offs.size())
      v.trade_offs[group].push_back({r.trade_muscle[k], r.trade_amount_N[k]});
  if (!std::isnan(r.mirrored)) v.mirrored = r.mirrored;
  v.mixed_optima = r.mixed_optima;
  for (size_t k = 0; k < r.either.size(); ++k)
    v.joint.push_back(
        {parted(r.either[k]), r.either_acts[k], r.either_low_N[k], r.either_high_N[k]});
  v.rms_mm = r.rms_mm, v.max_mm = r.max_mm, v.chi2_per_dof = r.chi2_per_dof;
  v.weight = r.weight;
  const size_t muscles = r.muscle.size();
  for (size_t k = 0; k < r.alternative_weight.size(); ++k) {
    Alternative other{r.alternative_weight[k], v.muscles, 1e-3 * r.alternative_rms_mm[k], {}};
    for (size_t i = 0; i < muscles && k * muscles + i < r.alternative_force_N.size(); ++i)
      other.muscles[i].best = r.alternative_force_N[k * muscles + i];
    v.alternatives.push_back(std::move(other));
  }
  v.iterations = r.ipopt_iterations, v.factorizations = r.factorizations, v.wall_s = r.wall_s;
  for (const auto& p : frame.points) v.measured.emplace_back(p.position[0], p.position[2]);
  for (size_t i = 0; i < r.line_x_mm.size(); ++i)
    v.predicted.emplace_back(1e-3 * r.line_x_mm[i], 1e-3 * r.line_z_mm[i]);
  return v;
}

int run_request(const RequestOptions& o) {
  const SharedKey key = key_of(o);
  // The server computes; the model is read here only to register contours or to draw.
  std::optional<Model> read;
  const auto model = [&]() -> const Model& {
    if (!read) read.emplace(read_model(o.model));
    return *read;
  };
  const Measured measured = read_measured(o.measured, model, print_line);
  Client client(choose_url(o.url), o.client, key);
  if (!client.connected())
    print_line(fmt::format("nobody listens on {} yet; waiting for up to {} s", choose_url(o.url),
                           o.timeout_s));
  bool all = true;
  for (const auto& frame : measured.frames) {
    bool told = false;
    const auto reply =
        client.request(request_of(frame, measured.noise, o), o.timeout_s, [&](const progress_t& p) {
          if (o.json) return;
          fmt::print(stderr, "\r{} {}: RMS {:.2f} mm   ", p.stage, p.iteration, p.rms_mm);
          told = true;
        });
    if (told) fmt::print(stderr, "\n");
    if (!reply)
      throw silence(fmt::format("no reply on {} within {} s; is 'genio serve' running?",
                                choose_url(o.url), o.timeout_s),
                    client);
    const AnswerView view = with_registration(view_of(*reply, frame), measured.registration);
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

/// The client's name in an id that Client made: "NAME-NUMBER".
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
