#pragma once
// Where else to start from: the valleys of a cheap stand-in for the misfit.

#include "inverse/search/atlas.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// The shape that the atlas foretells for any unknowns: each muscle's displacement by itself,
/// cubic between its entries and straight beyond them, and all of them added. Right to some
/// millimetres at moderate activations.
class AtlasShape {
 public:
  explicit AtlasShape(const Atlas& atlas);
  Positions operator()(const Vector& z) const;
  /// Its derivative, 3 n x unknowns.
  Matrix derivative(const Vector& z) const;

 private:
  struct Knot {
    double z;
    const Positions* shape;
    const Matrix* by_unknown;
  };
  /// Weights of the knots' displacements and slopes in unknown i's own displacement.
  struct Weights {
    size_t knot;
    double a, b, slope_a, slope_b;
  };
  static Weights weights(const std::vector<Knot>& knots, double z, bool derivative);

  const Atlas& atlas_;
  std::vector<std::vector<Knot>> knots_;  // of each unknown, rising; the first is the base
};

/// Valleys of misfit and prior over the atlas's shapes, the deepest first, at most `count`: by
/// multi-level single linkage from low-discrepancy points (NLopt's G_MLSL_LDS with L-BFGS; Rinnooy
/// Kan & Timmer 1987, Kucherenko & Sytsko 2005). Always the same for the same arguments.
std::vector<Atlas::Entry> valleys(const Atlas& atlas, const Comparison& comparison,
                                  const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                                  int count);

}  // namespace genio
