#include "discrepancy/contest/separation.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "discrepancy/conditions/condition_set.hpp"
#include "discrepancy/errors/error_model.hpp"
#include "forward/base/median.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/sensitivity.hpp"
#include "inverse/planning/further_measurements.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/moved_target.hpp"

namespace genio {
namespace {

constexpr double unknown = 0.15;  // activation of a muscle by itself
constexpr int line_points = 30;
constexpr double tolerance = 1e-5;   // of shapes
constexpr double near_zero = 1e-4;   // activation of a muscle known to rest
constexpr size_t lying = 4;          // postures, rest among them, that are tried lying, too
constexpr double usual_error = 0.1;  // of a known force, where no condition has one

/// The tongue of one model.
struct Tongue {
  explicit Tongue(const ModelDescription& d) : model(build_model(d, d.name)), workspace(model) {}
  bool has_weight() const { return model.description->effects.contains("gravity"); }
  Equilibrium posed(const Experiment& e, const Positions& start) {
    Parameters p = default_parameters(model);
    for (const auto& [name, f] : e.forces) set_command(model, name, f, p);
    if (e.pitch != 0 && has_weight()) p[parameter_index(model, "gravity.pitch")] = e.pitch;
    SolveOptions options;
    options.tolerance = tolerance;
    return solve_equilibrium(model, p, start, workspace, options);
  }
  Model model;
  Workspace workspace;
};

/// Nodes of the surface that come nearest to the observed points.
std::vector<int> seen_nodes(const Model& m, const Condition& condition) {
  std::vector<int> nodes;
  for (const SurfacePoint& s : condition.target.surface) {
    int nearest = -1;
    double least = 0;
    for (const Quad& q : m.surface)
      for (int a : q) {
        const double d = (m.mesh.nodes[size_t(a)] - s.position).squaredNorm();
        if (nearest < 0 || d < least) nearest = a, least = d;
      }
    nodes.push_back(nearest);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// What would be measured of a posture.
Target measured(const Model& m, const Positions& x, const HeadPose& laid,
                const std::vector<int>& nodes, double sigma, const std::string& further) {
  Target t = curve_target(m, x, line_points, sigma);
  for (int a : nodes) t.surface.push_back({node_position(x, a), sigma, a});
  if (!further.empty()) {
    const Target more = further_measurement(m, t, x, further).points;
    t.surface.insert(t.surface.end(), more.surface.begin(), more.surface.end());
    t.flesh = more.flesh;
  }
  // Data that need a pose lie moved the other way.
  const HeadPose moved{-laid.shift, -laid.turn};
  const Vec2 middle = t.middle();
  const MovedTarget move(moved, middle);
  for (CurvePoint& c : t.curve) c.position = move(c.position);
  for (SurfacePoint& s : t.surface) s.position = move(s.position);
  for (FleshPoint& f : t.flesh) f.position = move(f.position);
  return t;
}

/// Half the squared difference of the shapes that no command of the posture makes up for; negative
/// where there is none. `start`: near the shapes, then that of `a`.
double difference(Tongue& a, const HeadPose& a_laid, Tongue& b, const HeadPose& b_laid,
                  const Experiment& e, const Observations& o, const std::vector<int>& nodes,
                  double known_error, Positions& start, const std::string& further = {}) {
  const bool forces_known = known_error > 0;
  const Equilibrium x = a.posed(e, start);
  if (!x) return -1;
  start = x.x;
  const Equilibrium y = b.posed(e, x.x);
  if (!y) return -1;
  const Target target = measured(b.model, y.x, b_laid, nodes, o.noise, further);
  const Residuals r = Comparison(a.model, target)(x.x, a_laid);
  const auto unknowns = muscle_unknowns(a.model, o.bilateral && !forces_known);
  const Matrix solved = sensitivity_to_forces(
      a.model, x, force_by_unknown(a.model, unknowns, x.x, x.parameters), a.workspace);
  if (solved.size() == 0) return -1;
  const Eigen::LLT<Matrix> noise(noise_covariance(target, r, o.noise_correlation));
  const Matrix j = noise.matrixL().solve(residual_jacobian(r, solved));
  const Vector values = noise.matrixL().solve(r.values);
  Matrix h = j.transpose() * j;
  for (size_t i = 0; i < unknowns.size(); ++i) {
    double sd = o.effort_sd;
    if (forces_known) {
      sd = near_zero;
      for (int k : unknowns[i].parameters)
        sd = std::max(sd, known_error * x.parameters[k] / unknowns[i].scale);
    }
    h(Eigen::Index(i), Eigen::Index(i)) += 1 / (sd * sd);
  }
  const Vector slope = j.transpose() * values;
  return 0.5 * (values.squaredNorm() - slope.dot(h.llt().solve(slope)));
}

/// By what part of itself a force of a condition is uncertain, in the middle; 0: unknown forces.
double error_of_forces(const Condition& c) {
  if (!c.forces) return 0;
  std::vector<double> parts;
  for (const auto& [name, f] : *c.forces)
    if (f.mean > 0) parts.push_back(std::max(near_zero, f.sd / f.mean));
  return parts.empty() ? usual_error : median(std::move(parts));
}

constexpr const char* further_texts[] = {"slice=tip+25mm", "slice=dorsum", "slice=root",
                                         "slice=tip+25mm,dorsum,root",
                                         "sensors=tip+5mm,tip+20mm,tip+35mm"};

bool better(const Experiment& a, const Experiment& b) { return a.log_odds > b.log_odds; }

}  // namespace

std::string Experiment::label() const {
  std::string s;
  for (const auto& [name, f] : forces)
    s += fmt::format("{}{} {:.2g} N", s.empty() ? "" : ", ", name, f);
  if (s.empty()) s = "at rest";
  if (pitch > 0) s += ", lying on the back";
  if (pitch < 0) s += ", lying on the face";
  return s;
}

std::vector<Experiment> experiments(const PosedModel& one, const PosedModel& other,
                                    const Observations& o, size_t most) {
  const Condition& first = o.conditions.front();
  const double known = error_of_forces(first);
  Tongue a(one.model), b(other.model);
  const std::vector<int> nodes = seen_nodes(a.model, first);
  std::vector<std::pair<Experiment, Positions>> upright(1, {Experiment(), a.model.rest});
  for (const Unknown& c : muscle_unknowns(a.model, true))
    upright.push_back({{{{c.name, unknown * c.scale}}}, a.model.rest});
  std::vector<Experiment> all;
  const auto measure = [&](Experiment& e, Positions& start) {
    e.log_odds = difference(a, one.pose, b, other.pose, e, o, nodes, known, start);
    all.push_back(e);
  };
  for (auto& [e, shape] : upright) measure(e, shape);
  if (a.has_weight() || b.has_weight()) {
    // Weight adds about as much to each: the best ones and rest will do.
    std::stable_sort(upright.begin() + 1, upright.end(),
                     [](const auto& x, const auto& y) { return better(x.first, y.first); });
    upright.resize(std::min(upright.size(), lying));
    for (const double pitch : {90.0, -90.0})
      for (auto& [e, shape] : upright) e.pitch = pitch, measure(e, shape);
  }
  std::erase_if(all, [](const Experiment& e) { return e.log_odds < 0; });
  std::stable_sort(all.begin(), all.end(), better);
  if (all.size() > most) all.resize(most);
  if (!all.empty()) {
    Experiment& best = all.front();
    Positions start = a.model.rest;
    for (const char* text : further_texts) {
      const double odds =
          difference(a, one.pose, b, other.pose, best, o, nodes, known, start, text);
      if (odds >= 0) best.further.emplace_back(text, odds);
    }
    std::stable_sort(best.further.begin(), best.further.end(),
                     [](const auto& x, const auto& y) { return x.second > y.second; });
  }
  return all;
}

}  // namespace genio
