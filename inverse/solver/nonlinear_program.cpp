#include "inverse/solver/nonlinear_program.hpp"

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>
#include <mutex>
#include <stdexcept>

namespace genio {
namespace {

using Eigen::Map;
using Ipopt::Index;
using Ipopt::Number;

/// A NonlinearProgram as Ipopt asks for it.
class Adapter final : public Ipopt::TNLP {
 public:
  Adapter(NonlinearProgram& program, const Vector& start, ProgramResult& result)
      : program_(program),
        start_(start),
        result_(result),
        hessian_(program.hessian_entries()),
        jacobian_(program.jacobian_entries()) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hess,
                    IndexStyleEnum& style) override {
    n = Index(start_.size()), m = program_.constraints();
    nnz_jac = Index(jacobian_.size()), nnz_hess = Index(hessian_.size());
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* c_lower,
                       Number* c_upper) override {
    Map<Vector>(lower, n) = program_.lower();
    Map<Vector>(upper, n) = program_.upper();
    std::fill_n(c_lower, m, 0.0), std::fill_n(c_upper, m, 0.0);
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool init_z, Number*, Number*, Index,
                          bool init_lambda, Number*) override {
    Map<Vector>(x, n) = start_;
    return !init_z && !init_lambda;
  }
  bool eval_f(Index n, const Number* x, bool, Number& value) override {
    return program_.value(Map<const Vector>(x, n), value);
  }
  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    Vector g;
    if (!program_.gradient(Map<const Vector>(x, n), g)) return false;
    Map<Vector>(gradient, n) = g;
    return true;
  }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* values) override {
    Vector c;
    if (!program_.constraint_values(Map<const Vector>(x, n), c)) return false;
    if (m > 0) Map<Vector>(values, m) = c;
    return true;
  }
  bool eval_jac_g(Index n, const Number* x, bool, Index, Index count, Index* rows, Index* columns,
                  Number* values) override {
    if (values) return program_.jacobian(Map<const Vector>(x, n), std::span(values, size_t(count)));
    place(jacobian_, rows, columns);
    return true;
  }
  bool eval_h(Index n, const Number* x, bool, Number factor, Index m, const Number* lambda, bool,
              Index count, Index* rows, Index* columns, Number* values) override {
    if (values)
      return program_.hessian(Map<const Vector>(x, n), factor, Map<const Vector>(lambda, m),
                              std::span(values, size_t(count)));
    place(hessian_, rows, columns);
    return true;
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    result_.iterations = iteration;
    return program_.go_on(iteration);
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number* z_lower,
                         const Number* z_upper, Index m, const Number*, const Number* lambda,
                         Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    result_.v = Map<const Vector>(x, n);
    result_.lower_multipliers = Map<const Vector>(z_lower, n);
    result_.upper_multipliers = Map<const Vector>(z_upper, n);
    result_.multipliers = Map<const Vector>(lambda, m);
  }

 private:
  static void place(const NonlinearProgram::Entries& entries, Index* rows, Index* columns) {
    for (size_t k = 0; k < entries.size(); ++k)
      rows[k] = entries[k].first, columns[k] = entries[k].second;
  }

  NonlinearProgram& program_;
  const Vector& start_;
  ProgramResult& result_;
  const NonlinearProgram::Entries hessian_, jacobian_;
};

}  // namespace

ProgramResult solve(NonlinearProgram& program, const Vector& start, const ProgramOptions& o) {
  static std::mutex turn;
  const std::lock_guard lock(turn);
  ProgramResult result;
  Ipopt::SmartPtr<Adapter> problem = new Adapter(program, start, result);
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  bool accepted = true;
  const auto set = [&](const char* name, auto value) {
    if constexpr (std::is_same_v<decltype(value), const char*>)
      accepted &= app->Options()->SetStringValue(name, value);
    else if constexpr (std::is_same_v<decltype(value), int>)
      accepted &= app->Options()->SetIntegerValue(name, value);
    else accepted &= app->Options()->SetNumericValue(name, value);
  };
  if (program.hessian_entries().empty()) set("hessian_approximation", "limited-memory");
  set("print_level", 0);
  set("sb", "yes");
  set("linear_solver", "mumps");
  set("tol", o.tolerance);
  set("acceptable_tol", 100 * o.tolerance);
  set("acceptable_iter", 4);
  set("max_iter", o.max_iterations);
  set("nlp_scaling_method", "none");
  set("mu_strategy", "monotone");
  set("mu_init", o.barrier);
  set("mu_linear_decrease_factor", o.barrier_decrease);
  set("barrier_tol_factor", o.barrier_tolerance);
  set("bound_relax_factor", 0.0);
  set("bound_push", o.push);
  set("bound_frac", o.push);
  if (!accepted) throw std::logic_error("Ipopt refused an option");
  if (app->Initialize("") != Ipopt::Solve_Succeeded)
    throw std::logic_error("Ipopt could not be initialised");
  const auto status = app->OptimizeTNLP(problem);
  result.status = int(status);
  result.solved = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
  return result;
}

}  // namespace genio
