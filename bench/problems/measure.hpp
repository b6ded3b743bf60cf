#pragma once
// What a scanner sees of a shape: contours and surface points, without noise.

#include <random>

#include "forward/model/model.hpp"
#include "inverse/target/target.hpp"

namespace genio::bench {

struct Measured {
  Vec3 position;
  std::string kind;  ///< "curve" or "surface"
  int slice = 0;
};

/// The midsagittal line by `line` points and two coronal contours of the upper surface by `across`
/// points each; or `scattered` points of the surface seen from above and behind. Half a tongue
/// (y >= 0) stands for a whole one.
std::vector<Measured> contours_of(const Model& model, const Positions& x, int line, int across);
std::vector<Measured> surface_of(const Model& model, const Positions& x, int scattered,
                                 std::mt19937& random);

/// The points as a target of noise `sigma` [m].
Target target_of(const std::vector<Measured>& points, double sigma);

/// Adds noise of standard deviation `sd` to each coordinate in its plane, exp(-distance / length)
/// correlated along each contour (over the whole surface for scattered points).
void add_noise(std::vector<Measured>& points, double sd, double length, std::mt19937& random);

}  // namespace genio::bench
