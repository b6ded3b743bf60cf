#include "data/generator/example_files.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <stdexcept>

#include "forward/anatomy/refined_model.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/half_model.hpp"
#include "forward/motion/dynamics.hpp"
#include "forward/motion/motion_sensitivity.hpp"
#include "forward/statics/equilibrium.hpp"
#include "inverse/target/tongue_line.hpp"
#include "speaker/adaptation/outline_of_model.hpp"

namespace genio {
namespace {

using Newtons = std::map<std::string, double>;

fmt::ostream created(const std::string& folder, const std::string& file) {
  std::filesystem::create_directories(folder);
  return fmt::output_file(folder + "/" + file);
}

/// The model's equilibrium under these forces.
Positions shape_under(const Model& model, const Newtons& forces, Workspace& ws) {
  Parameters p = default_parameters(model);
  for (const auto& [muscle, newtons] : forces) set_command(model, muscle, newtons, p);
  const Equilibrium e = solve_equilibrium(model, p, model.rest, ws);
  if (!e) throw std::runtime_error(e.message);
  return e.x;
}

/// Points (x, z) of the midsagittal line [mm], each coordinate with noise of `sd` [mm].
std::vector<Vec2> seen_line(const Model& model, const Positions& x, int count, double sd,
                            Noise& noise) {
  std::vector<Vec2> points;
  for (const Vec2& q : TongueLine(model).sample(x, count)) {
    const double dx = sd * noise(), dz = sd * noise();
    points.emplace_back(1e3 * q[0] + dx, 1e3 * q[1] + dz);
  }
  return points;
}

/// A point (x, z) [mm] in the axes of the recording's device: the face looks right, the probe is
/// tilted by 12 degrees, and the origin is the probe.
Vec2 device_axes(const Vec2& q) {
  constexpr double tilt = 12 * std::numbers::pi / 180;
  const Vec2 d(110 - q[0], q[1] - 60);
  return {std::cos(tilt) * d[0] - std::sin(tilt) * d[1],
          std::sin(tilt) * d[0] + std::cos(tilt) * d[1]};
}

/// One row a contour, as AAA exports them: 14 columns, then a column for each coordinate.
void write_aaa(const std::string& folder, const std::string& file, const std::string& spline,
               const std::vector<std::pair<std::string, std::vector<Vec2>>>& contours) {
  auto out = created(folder, file);
  out.print("Client family name\tTime of sample in recording\tDate\tPrompt");
  for (size_t k = 0; k < contours.front().second.size(); ++k)
    out.print("\tX{} {}\tY{} {}", k, spline, k, spline);
  out.print("\n");
  int row = 0;
  for (const auto& [label, points] : contours) {
    out.print("example\t{:.2f}\t2026-11-28\t{}", 0.25 * row++, label);
    for (const Vec2& q : points) {
      const Vec2 d = device_axes(q);
      out.print("\t{:.2f}\t{:.2f}", d[0], d[1]);
    }
    out.print("\n");
  }
}

}  // namespace

double Noise::operator()() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += double(bits_()) / 4294967296.0;
  return sum;
}

void write_shape(const ModelDescription& tongue, const std::string& folder) {
  const Model model = build_model(tongue, tongue.name);
  Workspace ws(model);
  const Positions x = shape_under(model, {{"GGP", 2.5}, {"SL", 0.4}, {"TRANS", 1.0}}, ws);
  Noise noise(20261122);
  auto out = created(folder, "example_shape.csv");
  out.print("frame,point,x_mm,z_mm,sigma_mm,label\n");
  int number = 0;
  for (const Vec2& q : seen_line(model, x, 36, 0.3, noise))
    out.print("1,{},{:.3f},{:.3f},0.3,GGP 2.5 N with TRANS 1 N and SL 0.4 N\n", ++number, q[0],
              q[1]);
}

void write_recording(const ModelDescription& tongue, const std::string& folder) {
  const Model model = build_model(tongue, tongue.name);
  Workspace ws(model);
  Noise noise(20261128);
  std::vector<std::pair<std::string, std::vector<Vec2>>> contours;
  const std::pair<std::string, Newtons> postures[] = {{"rest", {}},
                                                      {"front", {{"GGP", 2.0}}},
                                                      {"back", {{"STY", 1.0}}},
                                                      {"low", {{"HG", 1.0}, {"GGA", 0.5}}}};
  for (const auto& [label, forces] : postures)
    contours.emplace_back(label, seen_line(model, shape_under(model, forces, ws), 42, 0.5, noise));
  write_aaa(folder, "contours.tsv", "Tongue", contours);

  std::vector<Vec2> trace;
  const auto cut = midsagittal_cut(model.palate.value()).front();
  for (size_t k = 0; k < 30; ++k) {
    const double place = double(k) * double(cut.size() - 1) / 29;
    const size_t before = std::min(size_t(place), cut.size() - 2);
    const double part = place - double(before);
    const Vec2 q = 1e3 * ((1 - part) * cut[before] + part * cut[before + 1]);
    const double dx = 0.5 * noise(), dz = 0.5 * noise();
    trace.emplace_back(q[0] + dx, q[1] + dz);
  }
  write_aaa(folder, "palate.tsv", "Roof", {{"swallow", trace}});
}

void write_word(const ModelDescription& tongue, const std::string& folder) {
  const Model model = build_model(tongue, tongue.name);
  Workspace ws(model);
  created(folder, "commands.csv").print("time_s,GGP_N,TRANS_N\n0,0,0\n0.05,2,0\n0.1,3,0.5\n");
  const auto commands = read_commands(model, folder + "/commands.csv", default_parameters(model));
  TimeOptions options;
  options.duration = 0.1;
  const Trajectory t = simulate(model, commands, model.rest, ws, options);
  if (!t) throw std::runtime_error(t.message);
  Noise noise(20261129);
  auto out = created(folder, "contours.csv");
  out.print("frame,point,x_mm,z_mm,sigma_mm,time_s\n");
  for (int frame = 1; frame <= 5; ++frame) {
    int number = 0;
    for (const Vec2& q : seen_line(model, shape_at(t, 0.02 * frame), 24, 0.3, noise))
      out.print("{},{},{:.3f},{:.3f},0.3,{:.2f}\n", frame, ++number, q[0], q[1], 0.02 * frame);
  }
}

void write_prior(const std::string& folder) {
  created(folder, "emg.csv").print("muscle,mean,sd\nTRANS,0.02,0.01\nHG,0,0.005\n");
  created(folder, "beliefs.toml")
      .print(
          "# What is known before the shape is seen.\n"
          "effort_sd = 0.12   # of every activation about 0\n"
          "emg = \"emg.csv\"    # measured activations; they replace effort for these muscles\n"
          "[fixed_N]\n"
          "MH = 0.0           # this muscle is known to rest\n"
          "[head_pose]        # estimated along with the forces\n"
          "shift_sd_mm = 0.5\n"
          "turn_sd_deg = 1.0\n");
}

void write_manifest(const std::string& folder) {
  created(folder, "corpus.csv")
      .print(
          "recording,palate,speaker,options\n"
          "recording/contours.tsv,recording/palate.tsv,S1,\"--labels \"\"front,back\"\"\"\n"
          "word/contours.csv,,S2,--sequence\n"
          "example_shape.csv,,S2,\n");
}

void write_observations(const ModelDescription& tongue, const std::string& folder) {
  ModelDescription truth = refined(half_of(tongue, tongue.name));
  truth.effects["airway_pressure"]["pressure"] = 400;
  const Model model = build_model(truth, "truth");
  Workspace ws(model);
  Noise noise(20261130);
  const std::pair<std::string, Newtons> postures[] = {{"rest", {}},
                                                      {"front", {{"GGP", 2.0}}},
                                                      {"back", {{"STY", 1.0}}},
                                                      {"low", {{"HG", 1.0}}},
                                                      {"between", {{"GGP", 1.0}, {"HG", 0.5}}}};
  auto toml = created(folder, "observations.toml");
  toml.print("noise_mm = 0.4\n");
  for (const auto& [name, forces] : postures) {
    auto out = created(folder, name + ".csv");
    out.print("frame,point,x_mm,z_mm\n");
    int number = 0;
    Newtons of_half = forces;
    for (auto& [muscle, newtons] : of_half) newtons /= 2;
    for (const Vec2& q : seen_line(model, shape_under(model, of_half, ws), 30, 0.4, noise))
      out.print("1,{},{:.3f},{:.3f}\n", ++number, q[0], q[1]);
    std::string known;
    for (const auto& [muscle, newtons] : forces)
      known += fmt::format("{}{} = {}", known.empty() ? "" : ", ", muscle, newtons);
    toml.print(
        "\n[[condition]]\nname = \"{0}\"\ntarget = \"{0}.csv\"\nforces_N = {{ {1} }}\n"
        "heldout = {2}\n",
        name, known, name == "between");
  }
}

void write_outline(const ModelDescription& tongue, const std::string& folder) {
  const auto smaller = [](const Vec2& p) {
    const double rise = 2.5e-3 * std::exp(-std::pow((p[0] - 0.095) / 0.02, 2));
    const Vec2 q(0.93 * p[0], 0.95 * p[1] + rise);
    return Vec2(0.02 + std::cos(0.1) * q[0] - std::sin(0.1) * q[1],
                std::sin(0.1) * q[0] + std::cos(0.1) * q[1] - 0.04);
  };
  auto out = created(folder, "outline.csv");
  out.print("segment,point,x_mm,y_mm\n");
  for (const auto& [segment, points] : outline_of_model(tongue, smaller, 1.5e-3).segments) {
    int number = 0;
    for (const Vec2& p : points)
      out.print("{},{},{:.2f},{:.2f}\n", segment_name(segment), ++number, 1e3 * p[0], 1e3 * p[1]);
  }
}

}  // namespace genio
