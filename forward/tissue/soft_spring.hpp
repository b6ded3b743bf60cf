#pragma once

namespace genio {

/// A one-sided spring that sets in softly: phi, phi' and phi'' at u > 0. phi'' rises linearly from
/// 0 to 1 over the depth `soft` and stays 1, so force and stiffness are continuous.
struct SoftSpring {
  double value = 0, slope = 0, curvature = 0;

  SoftSpring(double v, double s, double c) : value(v), slope(s), curvature(c) {}
  SoftSpring(double u, double soft) {
    if (u <= 0) return;
    if (u < soft) value = u * u * u / (6 * soft), slope = u * u / (2 * soft), curvature = u / soft;
    else value = u * u / 2 - soft * u / 2 + soft * soft / 6, slope = u - soft / 2, curvature = 1;
  }
};

}  // namespace genio
