#pragma once
// What the terms of a prior write into, and what several of them need.

#include "inverse/prior/base/prior_terms.hpp"
#include "inverse/prior/base/unknowns.hpp"

namespace genio {

struct Normal {
  double mean = 0, sd = 1;
};

/// Collects rows w.z = v with a standard deviation, and bounds of z.
class PriorRows {
 public:
  /// No row yet, and the unknowns' own bounds.
  explicit PriorRows(const std::vector<Unknown>& unknowns);

  void add(const Vector& weights, double value, double sd);
  /// A row about unknown i alone.
  void add(Eigen::Index i, double value, double sd);
  /// That z_i is small.
  void add_effort(Eigen::Index i, double sd) {
    add(i, 0, sd);
    effort_[i] = sd;
  }
  /// That z_i may rest, and has a slab of that scale where it acts.
  void may_rest(Eigen::Index i, double scale) { slab_[i] = scale; }
  /// True where a row speaks of unknown i alone.
  bool has(Eigen::Index i) const { return alone_[size_t(i)]; }
  /// Holds z_i at a value.
  void hold(Eigen::Index i, double z) { lower_[i] = upper_[i] = z; }

  PriorTerms terms() const;

 private:
  Vector lower_, upper_, effort_, slab_;
  std::vector<bool> alone_;
  std::vector<Vector> rows_;
  std::vector<double> values_;
};

/// Unknown muscles that a name speaks of: itself or its two sides. Throws InputError that begins
/// with `who` and suggests the nearest name where there is none.
std::vector<Eigen::Index> muscles_named(const std::vector<Unknown>& unknowns,
                                        const std::string& name, const char* who);

/// Throws InputError that begins with `what` unless the standard deviation is a number above 0.
void need_positive(double sd, const char* what);

}  // namespace genio
