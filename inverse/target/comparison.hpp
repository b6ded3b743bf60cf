#pragma once
// How far a shape is from what was measured.

#include <utility>
#include <vector>

#include "inverse/target/facets.hpp"
#include "inverse/target/head_pose.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// How wrong the model itself may be: other anatomy, fibre directions, discretisation. Standard
/// deviations of Gaussian fields on the tongue's surface are parts of the line's way from rest
/// (root mean square), or of each place's own.
struct ModelError {
  /// Of what a fit cannot absorb, for the verdict: of each place's own way, alike over a short
  /// length. What meshes, fibres and tissue laws do was measured so, see docs/inversion-method.md.
  double left = 0.08, left_length = 4e-3;
  double left_of_another = 0;  ///< and of the line's way, with `length`: another speaker's anatomy
  double length = 0.012;       ///< over which that is alike [m]
  double least = 1e-4;         ///< of any field [m]
  // For the posterior, set by `genio bench calibration`: a rough field, a smooth one, and a factor
  // of every muscle's force.
  double rough = 0.05, rough_length = 6e-3, smooth = 0.06, smooth_length = 0.02;
  /// Of the logarithm of what a newton does: at rest, and more a metre of the way from it, for the
  /// law of the tissue shows where it is strained.
  double efficacy_sd = 0.2, efficacy_by_way = 40;
  /// The same for a speaker who is laid beside the model.
  ModelError of_another_speaker() const {
    ModelError other = *this;
    other.efficacy_sd = 0.8, other.left_of_another = 0.05;
    return other;
  }
};

/// Noise-weighted residuals and their derivatives.
struct Residuals {
  /// Distance over sigma r, of a curve's point past the end of the line with how far past over
  /// its own sigma; with Student's t noise sign(r) sqrt(nu log(1 + r^2 / nu)), whose half square is
  /// the log-likelihood's loss (Lange, Little & Taylor 1989, for fixed nu, scaled to unit curvature
  /// at 0).
  Vector values;
  std::vector<std::vector<std::pair<int, Vec3>>>
      gradient;  ///< d value / d x_node [1/m], a row each
  Matrix pose;   ///< d value / d (shift x, shift z, turn), a row each
  struct Row {
    int point;     ///< index into places
    int axis;      ///< 0 to 2: along x, y, z; -1: across the surface
    double scale;  ///< d value / d distance [1/m]
  };
  std::vector<Row> rows;
  Vector distances;          ///< unweighted, one a point [m]
  std::vector<Vec3> places;  ///< where on the model, one a point [m]
  int outliers = 0;          ///< values beyond 3 sigma
  double rms = 0, max = 0;   ///< of distances [m]
};

/// Compares shapes with a target. Const; serves any number of threads.
class Comparison {
 public:
  /// `smoothing` [m]: a surface point's signed distance is the mean over twelve places that far
  /// about it. Faces meet at edges, and with hundreds of points each of which has to cross some, a
  /// descent would stop at every other edge; misfit_curvature() knows of no smoothing.
  Comparison(const Model& model, Target target, double smoothing = 0);
  Residuals operator()(const Positions& x, const HeadPose& pose = {}) const;
  const Target& target() const { return target_; }
  const TongueLine& line() const { return line_; }
  const Positions& rest() const { return rest_; }
  /// The middle of the target, which a head pose turns about, (x, z) [m].
  const Vec2& middle() const { return middle_; }
  void turn_about(const Vec2& middle) { middle_ = middle; }
  /// The nodes that residuals may depend on, rising.
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  Target target_;
  TongueLine line_;
  Positions rest_;
  std::vector<Facet> facets_;  // of the surface
  std::vector<Vec3> about_;    // where a surface point's distance is taken, from it
  std::vector<int> nodes_;
  Vec2 middle_;
};

/// Covariance of the residuals that a model error of standard deviation `sd` [m] makes.
Matrix model_error_covariance(const Residuals& residuals, double sd, double length);
/// The same of one standard deviation a row.
Matrix model_error_covariance(const Residuals& residuals, const Vector& sd, double length);

/// How far the surface is from rest where each residual was taken [m].
Vector ways_from_rest(const Residuals& residuals, const Positions& x, const Positions& rest);

/// What a fit leaves of the model's own error, as a covariance of the residuals. `way`: of the line
/// from rest, root mean square; `ways`: as of ways_from_rest() [m].
Matrix unabsorbed_error(const Residuals& residuals, const ModelError& error, double way,
                        const Vector& ways);

/// d residuals / d parameters: rows as in Residuals, `positions` = dx/dp (3 n x count).
Matrix residual_jacobian(const Residuals& residuals, const Matrix& positions);

}  // namespace genio
