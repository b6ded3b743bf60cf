#include "inverse/posterior/distributions.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace genio {
namespace {

using Plain = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double chi_square_tail(double chi2, double dof) {
  if (!(chi2 >= 0 && dof > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(chi2)) return 0;
  return boost::math::gamma_q(0.5 * dof, 0.5 * chi2, Plain());
}

double normal_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double normal_quantile(double tail) {
  return std::numbers::sqrt2 * boost::math::erfc_inv(2 * tail, Plain());
}

}  // namespace genio
