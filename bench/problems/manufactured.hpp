#pragma once

namespace genio::bench {

/// Manufactured deformation, two shears one after the other, on a cube of n^3 elements whose
/// interior nodes are shaken by `distortion` of their spacing; body forces by the law, exact
/// positions on the boundary: relative L2 error of the displacement. NaN where not solved.
double manufactured_error(int n, double poisson_ratio, double distortion);

}  // namespace genio::bench
