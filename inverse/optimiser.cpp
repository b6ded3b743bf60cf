#include "inverse/optimiser.hpp"

#include <fmt/format.h>

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>
#include <mutex>
#include <vector>

namespace genio {
namespace {

using Eigen::Map;
using Ipopt::Index;
using Ipopt::Number;

constexpr size_t patience = 5;           // iterations
constexpr double least_progress = 1e-3;  // in them, of the objective and of its unit

/// The objective as Ipopt asks for it.
class CommandProblem final : public Ipopt::TNLP {
 public:
  CommandProblem(Objective& objective, const Vector& start, const InferOptions& options,
                 OptimiserResult& result)
      : objective_(objective), start_(start), options_(options), result_(result) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hess,
                    IndexStyleEnum& style) override {
    n = Index(start_.size()), m = 0, nnz_jac = 0, nnz_hess = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index, Number*, Number*) override {
    Map<Vector>(lower, n) = objective_.prior().lower;
    Map<Vector>(upper, n) = objective_.prior().upper;
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool init_z, Number* z_l, Number* z_u, Index,
                          bool, Number*) override {
    Map<Vector>(x, n) = start_;
    if (init_z) std::fill_n(z_l, n, 1e-6), std::fill_n(z_u, n, 1e-6);
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    const auto* p = objective_.value(Map<const Vector>(x, n));
    if (p) value = p->value, remember(*p);
    return p != nullptr;
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    const auto* p = objective_.derivatives(Map<const Vector>(x, n));
    if (p) Map<Vector>(gradient, n) = p->gradient;
    return p != nullptr;
  }
  bool eval_g(Index, const Number*, bool, Index, Number*) override { return true; }
  bool eval_jac_g(Index, const Number*, bool, Index, Index, Index*, Index*, Number*) override {
    return true;
  }
  bool eval_h(Index n, const Number* x, bool, Number factor, Index, const Number*, bool, Index,
              Index* rows, Index* columns, Number* values) override {
    Matrix h;
    if (values) {
      const auto* p = objective_.derivatives(Map<const Vector>(x, n));
      if (!p) return false;
      h = factor * objective_.hessian(*p);
    }
    for (Index i = 0, k = 0; i < n; ++i)
      for (Index j = 0; j <= i; ++j, ++k) {
        if (values) values[k] = h(i, j);
        else rows[k] = i, columns[k] = j;
      }
    return true;
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    result_.iterations = iteration;
    if (options_.progress) options_.progress(iteration, best_rms_);
    // Stop on what the objective can still gain, in its own unit: with a large misfit the gradient
    // never gets as small as with a small one.
    settled_ = iteration > 0 && objective_.promised_gain() < options_.tolerance;
    // Where the tongue just touches bone the objective has kinks, and a smooth model promises
    // what is not there.
    best_values_.push_back(best_value_);
    stalled_ = best_values_.size() > patience &&
               best_values_[best_values_.size() - 1 - patience] - best_value_ <
                   least_progress * (1 + best_value_);
    return !settled_ && !stalled_ && !objective_.stopped();
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                         const Number*, Index, const Number*, const Number*, Number,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    final_ = Map<const Vector>(x, n);
  }
  bool settled() const { return settled_; }
  bool stalled() const { return stalled_; }
  const Vector& final_point() const { return final_; }
  const Vector& best_point() const { return best_; }

 private:
  void remember(const ObjectivePoint& p) {
    if (best_.size() && p.value >= best_value_) return;
    best_ = p.activations, best_value_ = p.value, best_rms_ = p.residuals.rms;
  }

  Objective& objective_;
  const Vector start_;
  const InferOptions& options_;
  OptimiserResult& result_;
  Vector final_, best_;
  double best_value_ = 0, best_rms_ = 0;
  std::vector<double> best_values_;  // after each iteration
  bool settled_ = false, stalled_ = false;
};

}  // namespace

OptimiserResult minimise(Objective& objective, const Vector& start, bool warm,
                         const InferOptions& options) {
  static std::mutex turn;
  const std::lock_guard lock(turn);
  OptimiserResult result;
  Ipopt::SmartPtr<CommandProblem> problem = new CommandProblem(objective, start, options, result);
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  bool accepted = true;
  const auto set = [&](const char* name, auto value) {
    if constexpr (std::is_same_v<decltype(value), const char*>)
      accepted &= app->Options()->SetStringValue(name, value);
    else if constexpr (std::is_same_v<decltype(value), int>)
      accepted &= app->Options()->SetIntegerValue(name, value);
    else accepted &= app->Options()->SetNumericValue(name, value);
  };
  if (options.finite_differences) set("hessian_approximation", "limited-memory");
  set("print_level", 0);
  set("sb", "yes");
  set("linear_solver", "mumps");
  set("tol", 1e-4);
  set("acceptable_tol", 1e-2);
  set("acceptable_iter", 4);
  set("max_iter", options.max_iterations);
  set("nlp_scaling_method", "none");
  set("mu_strategy", "monotone");
  set("mu_init", warm ? 1e-4 : 1e-2);
  set("mu_linear_decrease_factor", 0.1);
  set("barrier_tol_factor", 1000.0);  // the barrier is only a way to the bounds: hurry along it
  set("bound_relax_factor", 0.0);
  set("bound_push", warm ? 1e-4 : 1e-2);
  set("bound_frac", warm ? 1e-4 : 1e-2);
  if (!accepted) throw std::logic_error("Ipopt refused an option");
  if (app->Initialize("") != Ipopt::Solve_Succeeded)
    throw std::logic_error("Ipopt could not be initialised");
  const auto status = app->OptimizeTNLP(problem);
  const bool solved =
      status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  const bool settled = !objective.stopped() &&
                       (problem->settled() || objective.promised_gain() < 100 * options.tolerance);
  result.converged = solved || settled || (problem->stalled() && !objective.stopped());
  if (solved && problem->final_point().size()) result.activations = problem->final_point();
  else if (settled) result.activations = objective.latest()->activations;
  else result.activations = problem->best_point();
  if (!result.converged)
    result.message =
        fmt::format("the optimiser stopped (Ipopt status {}){}{}", int(status),
                    objective.last_failure().empty() ? "" : ": ", objective.last_failure());
  return result;
}

}  // namespace genio
