#include "report/answers/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "forward/base/text_file.hpp"
#include "report/pictures/plot.hpp"
#include "report/pictures/svg.hpp"
#include "runs/text/csv_text.hpp"

namespace genio {
namespace {

std::string counts(const AnswerRecords& answers, std::string AnswerRecord::*word) {
  std::map<std::string, int> count;
  for (const auto& [frame, a] : answers) ++count[a.*word];
  std::string text;
  for (const auto& [name, n] : count)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name);
  return text;
}

double quantile(std::vector<double> v, double p) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, size_t(p * double(v.size())))];
}

/// 0 where it is not there.
double value(const std::map<std::string, double>& by_muscle, const std::string& muscle) {
  const auto it = by_muscle.find(muscle);
  return it == by_muscle.end() ? 0 : it->second;
}

}  // namespace

std::string summary_text(const AnswerRecords& answers) {
  std::vector<double> rms, wall;
  for (const auto& [frame, a] : answers)
    if (a.converged()) rms.push_back(a.rms_mm), wall.push_back(a.wall_s);
  return fmt::format(
      "{} frames\nstatus   {}\nverdict  {}\nfit      RMS {:.2f} mm in the median, {:.2f} mm in the "
      "worst tenth\ntime     {:.2f} s a frame in the median\n",
      answers.size(), counts(answers, &AnswerRecord::status),
      counts(answers, &AnswerRecord::verdict), quantile(rms, 0.5), quantile(rms, 0.9),
      quantile(wall, 0.5));
}

void write_summary(const AnswerRecords& answers, const std::string& folder) {
  std::vector<std::string> muscles;
  for (const auto& [frame, a] : answers)
    if (a.converged()) {
      for (const auto& [name, force] : a.forces_N) muscles.push_back(name);
      break;
    }
  std::string csv = "frame,time_s,label,recording,speaker,status,verdict," + laid_titles() +
                    ",rms_mm,max_mm,chi2_per_dof";
  for (const auto& m : muscles)
    csv += fmt::format(",{0}_N,{0}_sd_N,{0}_acts,{0}_median_N,{0}_low90_N,{0}_high90_N", m);
  csv += "\n";
  std::vector<Series> series;
  for (const auto& m : muscles) series.push_back({m, {}});
  for (const auto& [frame, a] : answers) {
    csv += fmt::format("{},{},{},{},{},{},{}", frame, csv_number(a.time_s, 6), csv_field(a.label),
                       csv_field(a.recording), csv_field(a.speaker), a.status, a.verdict);
    csv += "," + laid_fields(a.registration);
    if (!a.converged()) {
      csv += std::string(3 + 6 * muscles.size(), ',') + "\n";
      continue;
    }
    csv += fmt::format(",{:.4g},{:.4g},{:.4g}", a.rms_mm, a.max_mm, a.chi2_per_dof);
    for (size_t m = 0; m < muscles.size(); ++m) {
      const std::string& name = muscles[m];
      csv += fmt::format(",{:.5g},{:.5g}", value(a.forces_N, name), value(a.sd_N, name));
      for (const auto* told : {&a.acts, &a.median_N, &a.low_N, &a.high_N})
        csv += "," + csv_number(*told, name, 5);
      const auto middle = a.median_N.find(name), most = a.max_force_N.find(name);
      const bool told = middle != a.median_N.end() && most != a.max_force_N.end();
      series[m].points.emplace_back(
          frame, 100 * (told ? middle->second / most->second : value(a.activation, name)));
    }
    csv += "\n";
  }
  write_text(folder + "/summary.csv", csv);
  if (muscles.empty()) return;
  const std::string svg = plot("Muscle forces, medians", "frame", "% of maximum", series, false,
                               false, laid_words(answers.begin()->second.registration));
  write_text(folder + "/summary.svg", svg);
  write_png(folder + "/summary.png", svg, 1.5);
}

}  // namespace genio
