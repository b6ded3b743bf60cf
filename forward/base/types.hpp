#pragma once
// The few names every room shares. SI units throughout; frame: x backwards (tip to root),
// y to the speaker's right, z up; midsagittal plane y = 0.

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <utility>

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
  explicit InputError(std::string reason) : std::runtime_error(one_line(std::move(reason))) {}

 private:
  /// Names and keys that a reason quotes may hold line ends.
  static std::string one_line(std::string text) {
    for (char& c : text)
      if (c >= 0 && c < ' ') c = ' ';
    return text;
  }
};

/// Position of node `a` [m].
inline auto node_position(const Positions& x, int a) { return x.segment<3>(3 * a); }

}  // namespace genio
