#include "bench/experiments/recordings/synthetic_session.hpp"

#include <fmt/format.h>

#include "bench/problems/random_muscles.hpp"
#include "forward/statics/equilibrium.hpp"
#include "inverse/prior/base/unknowns.hpp"
#include "inverse/recording/frame_target.hpp"

namespace genio::bench {
namespace {

constexpr double curve_noise = 0.4e-3, sensor_noise = 0.2e-3;  // [m]
constexpr int points = 42;
constexpr double px = 0.25e-3;  // a pixel of the images [m]

struct Posture {
  Positions shape;
  std::map<std::string, double> forces;
};

/// A shape of a few muscles at up to 30 % of their maxima.
Posture posture(const Model& model, Workspace& ws, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto commands = muscle_unknowns(model, true);
  for (;;) {
    Vector z = Vector::Zero(Eigen::Index(commands.size()));
    std::map<std::string, double> forces;
    for (int i : some_muscles(commands.size(), random, uniform)) {
      z[i] = 0.3 * uniform(random);
      forces[commands[size_t(i)].name] = z[i] * commands[size_t(i)].scale;
    }
    const Equilibrium e = solve_equilibrium(
        model, apply_unknowns(commands, z, default_parameters(model)), model.rest, ws);
    if (e) return {e.x, std::move(forces)};
  }
}

std::vector<Vec2> sensor_places(const Model& model, const Positions& x) {
  std::vector<Vec2> places;
  for (const char* name : {"tip", "blade", "dorsum"}) {
    Vec2 at = Vec2::Zero();
    for (const auto& [node, weight] : place_weights(model, name))
      at += weight * Vec2(x[3 * node], x[3 * node + 2]);
    places.push_back(at);
  }
  return places;
}

std::array<double, 3> numbers(const Vec2& q, const Similarity& s, const AxesReading& axes,
                              double unit) {
  const Vec2 moved = s(q);
  std::array<double, 3> v{};
  v[size_t(axes.back)] = (axes.back_grows ? 1 : -1) * moved[0] / unit;
  v[size_t(axes.up)] = (axes.up_grows ? 1 : -1) * moved[1] / unit;
  return v;
}

std::string spline_table(const std::vector<std::vector<std::array<double, 3>>>& frames,
                         const char* spline) {
  std::string text = "Prompt\tTime of sample in recording";
  for (size_t k = 0; k < frames[0].size(); ++k)
    text += fmt::format("\tX{} {}\tY{} {}", k, spline, k, spline);
  for (size_t f = 0; f < frames.size(); ++f) {
    text += fmt::format("\nword\t{:.3f}", 0.02 * double(f));
    for (const auto& v : frames[f]) text += fmt::format("\t{:.3f}\t{:.3f}", v[0], v[2]);
  }
  return text + "\n";
}

std::string column_pairs(const std::vector<std::vector<std::array<double, 3>>>& frames) {
  std::string text;
  for (size_t k = 0; k < frames[0].size(); ++k) {
    for (const auto& frame : frames)
      text += fmt::format("\t{:.2f}\t{:.2f}", frame[k][0], frame[k][2]);
    text += "\n";
  }
  return text;
}

std::string knot_rows(const std::vector<std::vector<std::array<double, 3>>>& frames) {
  std::string text = "FRAME\tTIME\tNOTE\tPOINT\tX\tY\n";
  for (size_t f = 0; f < frames.size(); ++f)
    for (size_t k = 0; k < frames[f].size(); ++k)
      text += fmt::format("{}\t{:.3f}\tword\t{}\t{:.2f}\t{:.2f}\n", f + 1, 0.02 * double(f), k + 1,
                          frames[f][k][0], frames[f][k][2]);
  return text;
}

std::string channels(const std::vector<std::vector<std::array<double, 3>>>& frames) {
  std::string text;
  for (size_t c = 1; c <= frames[0].size(); ++c)
    for (const char* part : {"X", "Y", "Z", "phi", "theta", "RMS", "Extra"})
      text += fmt::format("{}Ch{}_{}", text.empty() ? "" : "\t", c, part);
  for (const auto& frame : frames) {
    std::string row;
    for (const auto& v : frame)
      row += fmt::format("{}{:.2f}\t{:.2f}\t{:.2f}\t0\t0\t0.5\t0", row.empty() ? "" : "\t", v[0],
                         v[1], v[2]);
    text += "\n" + row;
  }
  return text + "\n";
}

std::string model_table(const std::vector<std::vector<std::array<double, 3>>>& frames) {
  std::string text = "frame,point,x_mm,z_mm\n";
  for (size_t f = 0; f < frames.size(); ++f)
    for (size_t k = 0; k < frames[f].size(); ++k)
      text += fmt::format("{},{},{:.3f},{:.3f}\n", f + 1, k + 1, frames[f][k][0], frames[f][k][2]);
  return text;
}

}  // namespace

SyntheticSession draw_session(const Model& model, Device device, std::mt19937& random, int frames) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal;
  Workspace ws(model);
  SyntheticSession s;
  s.device = device;
  const bool sensors = device == Device::articulograph;
  for (int f = 0; f < frames; ++f) {
    const auto [x, forces] = posture(model, ws, random);
    s.forces.push_back(forces);
    auto line = sensors ? sensor_places(model, x) : TongueLine(model).sample(x, points + 12);
    if (!sensors) line.erase(line.begin(), line.begin() + 12);  // ultrasound misses the underside
    for (Vec2& q : line)
      q += (sensors ? sensor_noise : curve_noise) * Vec2(normal(random), normal(random));
    s.frames.push_back(std::move(line));
  }
  const auto cut = midsagittal_cut(*model.palate).front();
  for (size_t k = cut.size() / 6; k < 2 * cut.size() / 3; ++k)
    s.palate.push_back(cut[k] + sensor_noise * Vec2(normal(random), normal(random)));
  if (device == Device::table) return s;
  s.target_to_device = {1 + 0.1 * uniform(random), 0.3 * uniform(random),
                        0.05 * Vec2(uniform(random), uniform(random))};
  s.palate_to_device = s.target_to_device;
  const bool mm = device == Device::aaa || sensors;
  s.target_unit = s.palate_unit = mm ? 1e-3 : px;
  if (device == Device::aaa) s.target_axes.back_grows = false;
  else if (sensors) {  // three devices: AG501, y along the head, y up
    const int kind = int(random() % 3);
    const std::pair<int, int> axes = kind == 0   ? std::pair{0, 2}
                                     : kind == 1 ? std::pair{1, 2}
                                                 : std::pair{0, 1};
    s.target_axes = {axes.first, axes.second, random() % 2 == 0, true};
  } else {
    s.target_axes = {0, 2, random() % 2 == 0, false};
  }
  s.palate_axes = s.target_axes;
  return s;
}

WrittenSession written(const SyntheticSession& s) {
  std::vector<std::vector<std::array<double, 3>>> target, palate(1), sweep;
  for (const auto& frame : s.frames) {
    auto& row = target.emplace_back();
    for (const Vec2& q : frame)
      row.push_back(numbers(q, s.target_to_device, s.target_axes, s.target_unit));
  }
  for (const Vec2& q : s.palate) {
    palate[0].push_back(numbers(q, s.palate_to_device, s.palate_axes, s.palate_unit));
    sweep.push_back({palate[0].back()});
  }
  WrittenSession w;
  w.options.read.mm_per_px =
      s.device == Device::edgetrak || s.device == Device::getcontours ? 1e3 * px : 0;
  switch (s.device) {
    case Device::aaa:
      w.target = "target.tsv", w.target_text = spline_table(target, "Tongue");
      w.palate = "palate.tsv", w.palate_text = spline_table(palate, "Roof");
      break;
    case Device::edgetrak:
      w.target = "target.con", w.target_text = column_pairs(target);
      w.palate = "palate.con", w.palate_text = column_pairs(palate);
      break;
    case Device::getcontours:
      w.target = "target.tsv", w.target_text = knot_rows(target);
      w.palate = "palate.tsv", w.palate_text = knot_rows(palate);
      break;
    case Device::articulograph:
      w.target = "target.txt", w.target_text = channels(target);
      w.palate = "sweep.txt", w.palate_text = channels(sweep);
      w.options.sensors = {"1=tip", "2=blade", "3=dorsum"}, w.options.palate_sensor = "1";
      break;
    case Device::table:
      w.target = "target.csv", w.target_text = model_table(target);
      break;
  }
  return w;
}

}  // namespace genio::bench
