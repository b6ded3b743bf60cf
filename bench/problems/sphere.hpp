#pragma once

namespace genio::bench {

/// Hollow sphere (inner radius 10, outer 20 mm) whose inner surface is blown up to `stretch`, in
/// six patches of n x n x layers elements: pressure on it over the exact one of the incompressible
/// law (Green & Zerna 1954; by quadrature). NaN where not solved.
double sphere_pressure_ratio(int n, int layers, double stretch);

}  // namespace genio::bench
