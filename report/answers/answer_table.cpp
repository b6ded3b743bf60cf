#include "report/answers/answer_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace genio {
namespace {

constexpr double sure = 0.95;  // probability

/// Each set of names once: two directions may name the same commands.
std::vector<std::vector<std::string>> told_once(const std::vector<std::vector<std::string>>& all) {
  std::set<std::vector<std::string>> known;
  std::vector<std::vector<std::string>> result;
  for (const auto& group : all) {
    auto sorted = group;
    std::sort(sorted.begin(), sorted.end());
    if (known.insert(sorted).second) result.push_back(group);
  }
  return result;
}

/// Which muscles act, which rest, and which the data leave open.
std::string acting_text(const AnswerView& v) {
  std::vector<std::string> surely, rest, open, known;
  for (const Estimate& c : v.muscles)
    (!std::isfinite(c.acts) ? known
     : c.acts >= sure       ? surely
     : c.acts <= 1 - sure   ? rest
                            : open)
        .push_back(c.name);
  if (surely.empty() && rest.empty() && open.empty()) return "";
  const auto list = [](const std::vector<std::string>& names) {
    return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
  };
  std::string out = fmt::format("act      surely {}; at rest {}; open {}\n", list(surely),
                                list(rest), list(open));
  if (!known.empty()) out += fmt::format("known    before: {}\n", list(known));
  for (const JointForce& j : v.joint)
    out += fmt::format("either   {}, together {:.2f} to {:.2f} N\n", fmt::join(j.names, " or "),
                       j.low, j.high);
  if (v.mirrored)
    out += fmt::format(
        "mirror   left and right may be exchanged ({} that they are); the intervals hold both\n",
        percent_text(*v.mirrored));
  return out;
}

}  // namespace

std::string percent_text(double probability) {
  if (probability > 0.99) return "> 99 %";
  if (probability < 0.01) return "< 1 %";
  return fmt::format("{:.0f} %", 100 * probability);
}

std::string to_table(const AnswerView& v) {
  std::string out;
  if (!v.muscles.empty())
    out += fmt::format("{:<8} {:>7} {:>9}   {:<17} {:>10} {:>7}\n", "muscle", "acts", "median N",
                       "90 % interval N", "best fit N", "% max");
  for (const auto& c : v.muscles)
    out += fmt::format("{:<8} {:>7} {:>9}   {:<17} {:10.2f} {:7.1f}\n", c.name,
                       std::isfinite(c.acts) ? percent_text(c.acts) : "-",
                       std::isfinite(c.median) ? fmt::format("{:.2f}", c.median) : "-",
                       std::isfinite(c.low) ? fmt::format("{:.2f} to {:.2f}", c.low, c.high) : "-",
                       c.best,
                       100 * c.best / c.maximum);
  out += acting_text(v);
  for (const auto& c : v.others)
    out += std::isfinite(c.low)
               ? fmt::format("{:<18} {:.3g} +- {:.2g} {}   {:.3g} to {:.3g}\n", c.name, c.best,
                             c.sd, c.unit, c.low, c.high)
               : fmt::format("{:<18} {:.3g} {}\n", c.name, c.best, c.unit);
  if (!v.muscles.empty())
    out += fmt::format("fit      RMS {:.2f} mm, max {:.2f} mm{}\n", v.rms_mm, v.max_mm,
                       std::isfinite(v.chi2_per_dof)
                           ? fmt::format(", chi2/dof {:.2f}", v.chi2_per_dof)
                           : "");
  for (const auto& group : told_once(v.unidentified))
    out += fmt::format("unseen   the data {}: {}\n",
                       group.size() > 1 ? "cannot tell apart" : "say little about",
                       fmt::join(group, ", "));
  for (const auto& other : v.alternatives) {
    out += fmt::format("also     weight {:.2f} (this one {:.2f}), RMS {:.2f} mm:", other.weight,
                       v.weight, 1e3 * other.rms);
    for (const auto& c : other.muscles)
      if (c.best > 0.01 * c.maximum) out += fmt::format(" {} {:.2f} N", c.name, c.best);
    out += "\n";
  }
  if (v.mixed_optima > 1)
    out += fmt::format("mixed    acts, median and interval hold {} optima by their weights\n",
                       v.mixed_optima);
  if (v.outliers > 0)
    out += fmt::format("outliers {} values beyond three standard deviations\n", v.outliers);
  out += fmt::format("status   {}\nverdict  {}{}{}\n", v.status, v.verdict,
                     v.message.empty() ? "" : ": ", v.message);
  return out;
}

std::string to_line(const AnswerView& v) {
  constexpr size_t shown = 3;
  std::string out = v.title + ": ";
  if (v.status != "converged")
    return out + fmt::format("{}{}{}", v.status, v.message.empty() ? "" : ": ", v.message);
  out += fmt::format("{}, RMS {:.2f} mm", v.verdict, v.rms_mm);
  std::vector<Estimate> largest;
  for (const Estimate& e : v.muscles)
    if (!(e.acts < 0.5) && !e.fixed) largest.push_back(e);
  const auto middle = [](const Estimate& e) {
    return (std::isfinite(e.median) ? e.median : e.best) / e.maximum;
  };
  std::stable_sort(largest.begin(), largest.end(),
                   [&](const Estimate& a, const Estimate& b) { return middle(a) > middle(b); });
  for (size_t i = 0; i < std::min(shown, largest.size()); ++i)
    out += fmt::format("{}{} {:.2f} to {:.2f} N", i == 0 ? "; " : ", ", largest[i].name,
                       largest[i].low, largest[i].high);
  return out;
}

}  // namespace genio
