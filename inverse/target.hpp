#pragma once
// What was measured of one tongue shape, and how far a shape is from it.

#include <Eigen/SparseCore>
#include <string>
#include <utility>
#include <vector>

#include "inverse/facets.hpp"
#include "inverse/head_pose.hpp"
#include "inverse/tongue_line.hpp"

namespace genio {

/// A point of the midsagittal contour; its place along the tongue is not known.
struct CurvePoint {
  Vec2 position;  ///< (x, z) [m]
  double sigma;   ///< noise across the contour [m]
};

/// A point of the tissue that was followed: a marked point of the surface, as in electromagnetic
/// articulography, or one of a volume registration.
struct FleshPoint {
  std::vector<std::pair<int, double>> at;  ///< nodes and their shares
  Vec3 position;                           ///< [m]; y is NaN where it was not measured
  double sigma;                            ///< [m], each coordinate
  std::string name;

  Vec3 on(const Positions& x) const;
};

/// A point of the tongue's surface in 3D, of a slice or a scan; its place on the surface is not
/// known.
struct SurfacePoint {
  Vec3 position;  ///< [m]
  double sigma;   ///< [m]
  int slice = 0;  ///< points of one slice were traced in one go: their noise may hang together
};

struct Target {
  std::vector<CurvePoint> curve;
  std::vector<FleshPoint> flesh;
  std::vector<SurfacePoint> surface;
  /// Degrees of freedom of Student's t noise, whose outliers count little; 0: Gaussian noise.
  double outlier_dof = 0;

  bool empty() const { return curve.empty() && flesh.empty() && surface.empty(); }
  /// True where nothing was measured off the midsagittal plane: left and right cannot be told
  /// apart.
  bool midsagittal() const;
  /// Middle of its points in the midsagittal plane, (x, z) [m].
  Vec2 middle() const;
};

/// Nodes and shares of the tissue point that lies at `rest` in the rest shape [m]. Throws
/// InputError when that is outside the tongue.
std::vector<std::pair<int, double>> tissue_point(const HexMesh& mesh, const Vec3& rest);

/// The midsagittal line of the shape `x` as a measurement of `count` points.
Target curve_target(const Model& model, const Positions& x, int count, double sigma);

/// How wrong the model itself may be, as a smooth Gaussian field on the tongue's surface: other
/// anatomy, fibre directions, discretisation. Set by `genio bench blind`.
struct ModelError {
  double part = 0.33;     ///< standard deviation, of the line's way from rest (root mean square)
  double left = 0.05;     ///< the same of what the fit cannot absorb, for the verdict
  double least = 1e-4;    ///< [m]
  double length = 0.012;  ///< of correlation [m]
};

/// Noise-weighted residuals and their derivatives.
struct Residuals {
  /// Distance over sigma r; with Student's t noise sign(r) sqrt(nu log(1 + r^2 / nu)), whose half
  /// square is the log-likelihood's loss (Lange, Little & Taylor 1989, for fixed nu, scaled to unit
  /// curvature at 0).
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
  /// descent would stop at every other edge; curvature() knows of no smoothing.
  Comparison(const Model& model, Target target, double smoothing = 0);
  Residuals operator()(const Positions& x, const HeadPose& pose = {}) const;
  /// sum_k value_k d2 value_k, what Gauss-Newton leaves out of the second derivatives of the
  /// misfit, over the 3 n nodal positions and then the pose (shift x, shift z, turn): entries of
  /// both halves of a symmetric matrix, duplicates to be added. `residuals`: those at x and pose.
  std::vector<Eigen::Triplet<double>> curvature(const Positions& x, const HeadPose& pose,
                                                const Residuals& residuals) const;
  const Target& target() const { return target_; }
  const TongueLine& line() const { return line_; }
  const Positions& rest() const { return rest_; }
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

/// d residuals / d parameters: rows as in Residuals, `positions` = dx/dp (3 n x count).
Matrix residual_jacobian(const Residuals& residuals, const Matrix& positions);

}  // namespace genio
