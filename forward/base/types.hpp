#pragma once
// The few names every room shares. SI units throughout; frame: x backwards (tip to root),
// y to the speaker's right, z up; midsagittal plane y = 0.

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace genio {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Nodal positions [m], 3 n values: x0 y0 z0 x1 y1 z1 ...
using Positions = Eigen::VectorXd;
/// Nodal forces [N], laid out like Positions.
using Forces = Eigen::VectorXd;

/// The caller's mistake: a bad file, name or value. The message is one line that names the file,
/// line or field and what was expected. The command line turns it into exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Position of node `a` [m].
inline auto node_position(const Positions& x, int a) { return x.segment<3>(3 * a); }

}  // namespace genio
