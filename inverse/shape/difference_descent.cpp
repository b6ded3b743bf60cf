#include "inverse/shape/difference_descent.hpp"

#include <fmt/format.h>

namespace genio {
namespace {

constexpr size_t patience = 5;           // iterations
constexpr double least_progress = 1e-3;  // in them, of the objective and of its unit

class Program final : public NonlinearProgram {
 public:
  Program(Objective& objective, DescentResult& result) : objective_(objective), result_(result) {}

  const Vector& lower() const override { return objective_.lower(); }
  const Vector& upper() const override { return objective_.upper(); }
  bool value(const Vector& v, double& f) override {
    const auto* p = objective_.at(v);
    if (!p) return false;
    f = p->value;
    if (result_.u.size() == 0 || f < result_.value) result_.u = v, result_.value = f;
    return true;
  }
  bool gradient(const Vector& v, Vector& g) override {
    const auto* p = objective_.at(v);
    if (!p) return false;
    g = objective_.difference_gradient(*p);
    return g.size() > 0;
  }
  bool go_on(int iteration) override {
    result_.iterations = result_.solver_iterations = iteration;
    values_.push_back(result_.value);
    result_.converged =
        values_.size() > patience && values_[values_.size() - 1 - patience] - result_.value <
                                         least_progress * (1 + result_.value);
    return !result_.converged && !objective_.stopped();
  }

 private:
  Objective& objective_;
  DescentResult& result_;
  std::vector<double> values_;  // after each iteration
};

}  // namespace

DescentResult descend_by_differences(Objective& objective, const Vector& start,
                                     const DescentOptions& options) {
  DescentResult result;
  Program program(objective, result);
  ProgramOptions how;
  how.max_iterations = options.max_iterations;
  how.tolerance = options.tolerance;
  how.barrier = 1e-4, how.barrier_tolerance = 1000;
  const ProgramResult r = solve(program, start, how);
  result.converged |= r.solved;
  if (!result.converged)
    result.message = fmt::format("the optimiser stopped (Ipopt status {}): {}", r.status,
                                 objective.last_failure());
  return result;
}

}  // namespace genio
