#include "report/discovery/discovery_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/discovery/discovery_pictures.hpp"
#include "report/pictures/svg.hpp"

namespace genio {
namespace {

std::string gap_row(const char* what, const Gap& before, const Gap& after, double noise) {
  return fmt::format(
      "<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td></tr>\n", what,
      1e3 * before.rms, 1e3 * after.rms, before.rms / noise, after.rms / noise);
}

/// " N", and nothing where there is none.
std::string after_number(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

/// Along which axis a force pulls most.
const char* towards(const Vec3& force) {
  Eigen::Index axis = 0;
  force.cwiseAbs().maxCoeff(&axis);
  const char* const ways[][2] = {
      {"forwards", "backwards"}, {"to the left", "to the right"}, {"down", "up"}};
  return ways[axis][force[axis] > 0];
}

std::string effects_part(const Discovery& d) {
  std::string s;
  for (const NamedEffect& e : d.effects) {
    s += fmt::format("<h3>{}</h3><p>Probability among all models tried: {:.3f}.</p>\n<table>",
                     escaped(label(e.effect, e.where)), e.confidence);
    s += "<tr><th>parameter</th><th>value</th><th>sd</th><th>90 % interval</th><th>unit</th></tr>";
    for (const SharedEstimate& p : e.parameters)
      s += fmt::format(
          "<tr><td>{}</td><td>{:.4g}</td><td>{:.2g}</td><td>{:.4g} to {:.4g}</td>"
          "<td>{}</td></tr>\n",
          escaped(p.name.text()), p.value, p.sd, p.low, p.high, escaped(p.unit));
    s += "</table>\n";
  }
  if (d.effects.empty()) s += "<p>No effect is named.</p>\n";
  for (const AlternativeEffect& r : d.alternatives) {
    s += fmt::format(
        "<p>Or {}: probability {:.3f}; its signature is like the first one's by "
        "{:.2f}.",
        escaped(label(r.effect, r.where)), r.probability, r.similarity);
    if (!r.apart.empty()) {
      s += " To tell them apart, measure (expected log odds in brackets):";
      for (const Experiment& e : r.apart)
        s += fmt::format(" {} ({:.1f});", escaped(e.label()), e.log_odds);
      s.back() = '.';
      if (const auto& further = r.apart.front().further; !further.empty())
        s += fmt::format(" Of the first posture, {} would bring {:.1f}.",
                         escaped(further.front().first), further.front().second);
    }
    s += "</p>\n";
  }
  return s;
}

/// How strong what was looked for would have to be for these data to show it.
std::string detectable_part(const Round& round) {
  std::string s = "<table><tr><th>candidate</th><th>seen nine times in ten from</th></tr>";
  for (const RankedCandidate& r : round.candidates) {
    if (!r.score.visible) {
      s += fmt::format("<tr><td>{}</td><td>never by these data</td></tr>\n",
                       escaped(r.candidate.label()));
      continue;
    }
    std::vector<std::string> from;
    for (const FreeNumber& n : r.candidate.strengths)
      from.push_back(fmt::format(
          "{} {} {:.3g}{}", n.name, r.candidate.strengths.size() > 1 ? "about" : "off by",
          n.at(r.score.detectable * n.belief.typical) - n.info.absent, after_number(n.info.unit)));
    s += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(r.candidate.label()),
                     escaped(fmt::format("{}", fmt::join(from, " or "))));
  }
  return s + "</table>\n";
}

std::string families_part(const Discovery& d) {
  std::string s;
  for (const ConfoundedSet& f : d.confounded_sets)
    s += fmt::format("<p>Never told apart by these data ({}): {}; {}.</p>\n", escaped(f.name),
                     escaped(fmt::format("{}", fmt::join(f.members, ", "))), escaped(f.why));
  return s;
}

std::string patches_part(const Discovery& d, const Observations& o) {
  const auto& patches = d.map_before.patches;
  if (patches.empty())
    return fmt::format("<p>No place lies beyond noise (false-discovery rate {} %).</p>\n",
                       100 * d.map_before.false_discovery_rate);
  std::string s =
      "<table><tr><th>condition</th><th>place</th><th>points</th><th>data lie</th></tr>";
  for (size_t i = 0; i < std::min<size_t>(patches.size(), 12); ++i)
    s += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.2f} mm {}</td></tr>\n",
                     escaped(o.conditions[patches[i].condition].name), patches[i].region,
                     patches[i].points, 1e3 * std::abs(patches[i].mean),
                     patches[i].mean > 0 ? "outside" : "inside");
  return s + "</table>\n";
}

}  // namespace

std::string discovery_page(const Discovery& d, const Observations& o, const std::string& title) {
  std::string s = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><title>{0}</title>\n"
      "<style>body{{font-family:sans-serif;max-width:60em;margin:2em auto;color:#222}}"
      "table{{border-collapse:collapse}}td,th{{border:1px solid #ccc;padding:.3em .7em;"
      "text-align:left}}svg{{max-width:100%;height:auto}}</style></head><body>\n<h1>{0}</h1>\n"
      "<p><b>{1}</b>: {2}.</p>\n",
      escaped(title), to_string(d.verdict), escaped(d.message));
  s += "<h2>Where</h2>\n" + patches_part(d, o);
  if (d.hidden.log_evidence > 0)
    s += fmt::format(
        "<p>The smallest force field that would close the gap: {:.2g} N in all, about the {} "
        "(x {:.0f}, y {:.0f}, z {:.0f} mm); together ({:.2g}, {:.2g}, {:.2g}) N along x, y and z, "
        "mostly {}; log evidence {:.1f} over none.</p>\n",
        d.hidden.total, d.hidden.region, 1e3 * d.hidden.centre[0], 1e3 * d.hidden.centre[1],
        1e3 * d.hidden.centre[2], d.hidden.resultant[0], d.hidden.resultant[1],
        d.hidden.resultant[2], towards(d.hidden.resultant), d.hidden.log_evidence);
  s += "<h2>What</h2>\n" + effects_part(d);
  s +=
      "<h2>How sure</h2>\n<p>Log odds against nothing being missing; dark: refitted in full, pale: "
      "by the score alone.</p>\n";
  for (size_t i = 0; i < d.rounds.size(); ++i)
    s += fmt::format(
        "<h3>Effect {}</h3>\n<p>Chi-square {:.0f} of {:.0f} degrees of freedom before; "
        "probability that nothing (more) is missing {:.2g}.</p>\n{}",
        i + 1, d.rounds[i].chi_square, d.rounds[i].dof, d.rounds[i].nothing,
        draw_ranking(d.rounds[i], 14));
  if (!d.rounds.empty())
    s += "<h3>What these data could show</h3>\n" + detectable_part(d.rounds.back());
  s += families_part(d);
  s += fmt::format(
      "<h2>What changed</h2>\n<table><tr><th>gap, RMS</th><th>before [mm]</th><th>after [mm]</th>"
      "<th>before / noise</th><th>after / noise</th></tr>\n{}{}</table>\n<p>Noise {:.2f} mm; what "
      "is left is noise with p = {:.2g}.</p>\n<h3>Distance of the data from the surface</h3>\n{}"
      "<h3>Midsagittal contours</h3>\n<p>Dots: measured; dashed: the model as it was; line: as it "
      "is now.</p>\n{}</body></html>\n",
      gap_row("fitted conditions", d.before, d.after, d.noise),
      gap_row("held-out conditions", d.heldout_before, d.heldout_after, d.noise), 1e3 * d.noise,
      d.fit_tail, draw_maps(d, o), draw_contours(d, o));
  return s;
}

}  // namespace genio
