#include "report/answers/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace genio {
namespace {

constexpr size_t most_shown = 6;        // muscles
constexpr double worth_showing = 0.01;  // width over the maximum

/// Indices by falling keys.
template <class Key>
std::vector<size_t> falling(size_t count, Key key) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) > key(b); });
  return order;
}

std::vector<size_t> best_first(const Prospects& p) {
  return falling(p.further.size(), [&](size_t k) { return p.further[k].gain; });
}

/// Muscles of which least is known.
std::vector<size_t> widest(const Prospects& p) {
  const auto width = [&](size_t m) { return p.before[m].width / p.maximum[m]; };
  std::vector<size_t> order = falling(p.muscles.size(), width);
  std::erase_if(order, [&](size_t m) { return width(m) < worth_showing; });
  if (order.size() > most_shown) order.resize(most_shown);
  return order;
}

nlohmann::json json_of(const std::vector<std::string>& muscles, const std::vector<Doubt>& doubts) {
  nlohmann::json widths = nlohmann::json::object(), acts = nlohmann::json::object();
  for (size_t m = 0; m < muscles.size(); ++m)
    widths[muscles[m]] = doubts[m].width, acts[muscles[m]] = doubts[m].acts;
  return {{"width_N", std::move(widths)}, {"doubt", std::move(acts)}};
}

}  // namespace

std::string plan_table(const Prospects& p) {
  const auto shown = widest(p);
  size_t name = 11;
  for (const Prospect& f : p.further) name = std::max(name, f.name.size());
  std::string out = fmt::format("{:<{}} {:>6} {:>10}", "measurement", name, "values", "takes away");
  for (const size_t m : shown) out += fmt::format(" {:>8}", p.muscles[m]);
  out += fmt::format("\n{:<{}} {:>6} {:>10}", "now, width N", name, "", "");
  for (const size_t m : shown) out += fmt::format(" {:8.2f}", p.before[m].width);
  out += "\n";
  for (const size_t k : best_first(p)) {
    const Prospect& f = p.further[k];
    out += fmt::format("{:<{}} {:>6} {:>8.0f} %", f.name, name, f.values, 100 * f.gain);
    for (const size_t m : shown) out += fmt::format(" {:8.2f}", f.muscles[m].width);
    out += "\n";
  }
  return out;
}

std::string plan_json(const Frame& frame, const Answer& answer, const Prospects& p) {
  nlohmann::json json = {
      {"frame", frame.contour.number},        {"status", to_string(answer.status)},
      {"verdict", to_string(answer.verdict)}, {"message", answer.message},
      {"now", json_of(p.muscles, p.before)},  {"measurements", nlohmann::json::array()}};
  for (const size_t k : best_first(p)) {
    const Prospect& f = p.further[k];
    nlohmann::json one = json_of(p.muscles, f.muscles);
    one["name"] = f.name, one["values"] = f.values, one["takes_away"] = f.gain;
    json["measurements"].push_back(std::move(one));
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace genio
