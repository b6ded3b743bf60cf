#include "speaker/indentation/tissue_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <optional>
#include <stdexcept>

#include "forward/base/elapsed.hpp"
#include "speaker/indentation/curve_between.hpp"

namespace genio {
namespace {

constexpr double usual_ratio = 90.0 / 192;  // a20 over a10 of dead muscle (Gerard et al. 2005)
constexpr double least_a10 = 1;             // [Pa]
constexpr double quantile95 = 1.6448536;    // of the normal distribution

/// Why a simulation gives no curve. It passes through the optimiser.
struct NoCurve : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// a10 of a half space with the force at the greatest depth, softened as deep tissue stiffens.
double rough_a10(const IndentationExperiment& e, const ForceData& data) {
  const Eigen::Index last = data.depth.size() - 1;
  const double d = data.depth[last], over = 8;  // E / (1 - nu^2) over a10
  const double per_a10 = e.indenter == Indenter::sphere
                             ? 4.0 / 3 * over * std::sqrt(e.radius) * std::pow(d, 1.5)
                             : 2 * over * e.radius * d;
  return std::clamp(data.force.maxCoeff() / (1.5 * per_a10), 10.0, 1e6);
}

class FitProblem {
 public:
  FitProblem(const IndentationExperiment& e, const ForceData& data, const TissueFitOptions& o)
      : data_(data),
        options_(o),
        between_(data.depth, e.indenter),
        unknowns_(e.mucosa > 0 && o.fit_mucosa ? 3 : 2),
        start_{{rough_a10(e, data), usual_ratio * rough_a10(e, data)}, o.mucosa},
        model_(e, between_.nodes.back(), start_, o.grid),
        ws_(model_.model) {
    weight_ =
        data.sd ? data.sd->cwiseInverse().eval()
        : o.relative_scatter
            ? data.force.cwiseAbs().cwiseMax(0.01 * data.force.maxCoeff()).cwiseInverse().eval()
            : Vector::Ones(data.depth.size()).eval();
    // The first touch says nothing: it is where depths are counted from.
    for (Eigen::Index i = 0; i < weight_.size(); ++i)
      if (!(data.depth[i] > 0)) weight_[i] = 0;
    rows_ = (weight_.array() > 0).count();
  }

  bool known_scatter() const { return data_.sd.has_value(); }
  Eigen::Index freedom() const { return rows_ - unknowns_; }
  Vector start() const { return values(start_); }
  Vector lower() const {
    Vector low = Vector::Zero(unknowns_);
    low[0] = least_a10;
    if (unknowns_ > 2) low[2] = least_a10;
    return low;
  }

  BlockTissue tissue(const Vector& v) const {
    BlockTissue t{{v[0], v[1]}, options_.mucosa};
    if (unknowns_ > 2) t.mucosa = {v[2], v[2] * options_.mucosa.a20 / options_.mucosa.a10};
    return t;
  }
  Vector values(const BlockTissue& t) const {
    Vector v(unknowns_);
    v.head(2) << t.muscle.a10, t.muscle.a20;
    if (unknowns_ > 2) v[2] = t.mucosa.a10;
    return v;
  }

  /// Simulates the curve of the constants `v`. Throws NoCurve.
  void simulate(const Vector& v) {
    if (at_ && *at_ == v) return;
    if (fit.simulations == options_.most_simulations)
      throw NoCurve(fmt::format("not converged in {} simulations", fit.simulations));
    ++fit.simulations;
    ForceCurve curve = solve_force_curve(model_, tissue(v), between_.nodes, ws_,
                                         fit.curve.points.empty() ? nullptr : &fit.curve);
    fit.newton_iterations += curve.newton_iterations;
    fit.factorizations += curve.factorizations;
    fit.equilibria += int(curve.points.size());
    if (!curve) throw NoCurve(curve.message);
    const auto n = Eigen::Index(between_.nodes.size());
    Vector force(n);
    Matrix derivative(n, unknowns_);
    for (Eigen::Index k = 0; k < n; ++k) {
      const ForcePoint& p = curve.points[size_t(k)];
      force[k] = p.force;
      derivative.row(k).head(2) << p.derivative[by_a10], p.derivative[by_a20];
      if (unknowns_ > 2)
        derivative(k, 2) = p.derivative[by_mucosa_a10] +
                           options_.mucosa.a20 / options_.mucosa.a10 * p.derivative[by_mucosa_a20];
    }
    fit.curve = std::move(curve);
    predicted = between_.weights * force;
    jacobian = weight_.asDiagonal() * (between_.weights * derivative);
    residual = weight_.cwiseProduct(predicted - data_.force);
    at_ = v;
    if (options_.progress) options_.progress(fit.simulations, rms());
  }

  double rms() const {
    double sum = 0;
    for (Eigen::Index i = 0; i < weight_.size(); ++i)
      if (weight_[i] > 0) sum += std::pow(predicted[i] - data_.force[i], 2);
    return std::sqrt(sum / double(rows_));
  }

  TissueFit fit;
  Vector predicted, residual;  // weighted residual
  Matrix jacobian;             // of the weighted residual by the unknowns

 private:
  const ForceData& data_;
  const TissueFitOptions& options_;
  CurveBetween between_;
  Eigen::Index unknowns_, rows_ = 0;
  BlockTissue start_;
  IndentationModel model_;
  Workspace ws_;
  Vector weight_;
  std::optional<Vector> at_;
};

/// The best constants that the curve at `v` foretells, the ratio of a20 to a10 kept: forces are
/// linear in all constants together.
Vector scaled_start(FitProblem& problem, const Vector& v) {
  problem.simulate(v);
  const Vector muscle = problem.jacobian.leftCols(2) * v.head(2);
  const Vector wanted = muscle - problem.residual;
  Vector scaled = v;
  scaled.head(2) *= std::clamp(muscle.dot(wanted) / muscle.squaredNorm(), 0.05, 20.0);
  return scaled;
}

/// Unknowns z with v = centre + spread z, about independent and of unit variance.
struct Whitened {
  Vector centre;
  Matrix spread;
};

/// `scale`: of the squares that a standard deviation makes.
Whitened whitened(const FitProblem& problem, const Vector& v, double scale) {
  Matrix information = problem.jacobian.transpose() * problem.jacobian / scale;
  // Constants that the curve says nothing of change by their own size.
  for (Eigen::Index i = 0; i < v.size(); ++i)
    information(i, i) += 1 / std::pow(std::max(v[i], 10.0), 2);
  const Eigen::LLT<Matrix> llt(information);
  return {v, llt.matrixU().solve(Matrix::Identity(v.size(), v.size()))};
}

struct Objective {
  FitProblem& problem;
  Whitened unknowns;
  double scale;  // of the squares
  std::string failure;

  Vector at(const std::vector<double>& z) const {
    const Vector v = unknowns.centre +
                     unknowns.spread * Eigen::Map<const Vector>(z.data(), Eigen::Index(z.size()));
    return v.cwiseMax(problem.lower());
  }
  double operator()(const std::vector<double>& z, std::vector<double>& gradient) {
    problem.simulate(at(z));
    if (!gradient.empty())
      Eigen::Map<Vector>(gradient.data(), Eigen::Index(gradient.size())) =
          unknowns.spread.transpose() * (problem.jacobian.transpose() * problem.residual) / scale;
    return 0.5 * problem.residual.squaredNorm() / scale;
  }
};

double objective_of(const std::vector<double>& z, std::vector<double>& gradient, void* data) {
  Objective& o = *static_cast<Objective*>(data);
  try {
    return o(z, gradient);
  } catch (const NoCurve& e) {
    o.failure = e.what();
    throw nlopt::forced_stop();
  }
}

/// lower - v(z) <= 0 of one constant.
struct AboveBound {
  const Objective* objective;
  Eigen::Index constant;
};

double bound_of(const std::vector<double>& z, std::vector<double>& gradient, void* data) {
  const auto& b = *static_cast<const AboveBound*>(data);
  const Whitened& u = b.objective->unknowns;
  const auto n = Eigen::Index(z.size());
  const double size = u.spread.row(b.constant).norm();
  if (!gradient.empty())
    Eigen::Map<Vector>(gradient.data(), n) = -u.spread.row(b.constant).transpose() / size;
  return (b.objective->problem.lower()[b.constant] - u.centre[b.constant] -
          u.spread.row(b.constant).dot(Eigen::Map<const Vector>(z.data(), n))) /
         size;
}

/// The best constants by NLopt. Throws NoCurve.
Vector minimise(FitProblem& problem, const Vector& start) {
  problem.simulate(start);
  const double squares = problem.residual.squaredNorm() / double(problem.freedom()),
               scale = problem.known_scatter() ? std::max(1.0, squares) : std::max(1e-30, squares);
  Objective objective{problem, whitened(problem, start, scale), scale, {}};
  const auto n = unsigned(start.size());
  nlopt::opt optimiser(nlopt::LD_SLSQP, n);
  optimiser.set_min_objective(objective_of, &objective);
  std::vector<AboveBound> bounds;
  for (unsigned i = 0; i < n; ++i) bounds.push_back({&objective, Eigen::Index(i)});
  for (AboveBound& b : bounds) optimiser.add_inequality_constraint(bound_of, &b, 1e-9);
  optimiser.set_xtol_abs(5e-3);
  optimiser.set_ftol_abs(1e-5);
  std::vector<double> z(n, 0.0);
  double least = 0;
  try {
    optimiser.optimize(z, least);
  } catch (const nlopt::forced_stop&) {
    throw NoCurve(objective.failure);
  } catch (const nlopt::roundoff_limited&) {  // as near as it gets
  }
  return objective.at(z);
}

/// What the curve says of the constants v. Throws NoCurve.
void judge(FitProblem& problem, const Vector& v) {
  TissueFit& fit = problem.fit;
  const double squares = problem.residual.squaredNorm() / double(problem.freedom());
  Matrix information = problem.jacobian.transpose() * problem.jacobian;
  const double variance = problem.known_scatter() ? 1 : squares;
  const Vector size = information.diagonal().cwiseSqrt();
  const Matrix scaled =
      size.cwiseInverse().asDiagonal() * information * size.cwiseInverse().asDiagonal();
  const Eigen::LDLT<Matrix> ldlt(scaled);
  if (!(ldlt.vectorD().minCoeff() > 1e-10))
    throw NoCurve("the curve cannot tell the constants apart; deeper or more depths would");
  fit.covariance = size.cwiseInverse().asDiagonal() *
                   ldlt.solve(Matrix::Identity(v.size(), v.size())) *
                   size.cwiseInverse().asDiagonal() * variance;
  const Vector low = problem.lower();
  const char* names[] = {"a10", "a20", "mucosa_a10"};
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const double sd = std::sqrt(fit.covariance(i, i));
    fit.constants.push_back({names[i], v[i], sd, std::max(low[i], v[i] - quantile95 * sd),
                             v[i] + quantile95 * sd, v[i] < low[i] + 1e-3 * sd});
  }
  fit.tissue = problem.tissue(v);
  fit.young_modulus = 6 * v[0];
  fit.rms = problem.rms();
  fit.chi2_per_dof = problem.known_scatter() ? squares : 1;
  fit.scatter = problem.known_scatter() ? 0 : std::sqrt(squares);
  fit.predicted = problem.predicted;
}

}  // namespace

TissueFit fit_tissue(const IndentationExperiment& experiment, const ForceData& data,
                     const TissueFitOptions& options) {
  const Stopwatch elapsed;
  FitProblem problem(experiment, data, options);
  try {
    if (problem.freedom() < 1) throw NoCurve("fewer forces than constants");
    const Vector start = scaled_start(problem, problem.start());
    const Vector best = minimise(problem, start);
    problem.simulate(best);
    judge(problem, best);
  } catch (const NoCurve& e) {
    problem.fit.message = e.what();
  }
  problem.fit.wall_s = elapsed.seconds();
  return std::move(problem.fit);
}

}  // namespace genio
