#include "speaker/indentation/experiment.hpp"

#include <fmt/format.h>

#include "forward/base/types.hpp"

namespace genio {
namespace {

void expect_range(const char* what, double metres, double low, double high) {
  if (!(metres >= low && metres <= high))
    throw InputError(fmt::format("{}: {:g} mm; expected {:g} to {:g} mm", what, 1e3 * metres,
                                 1e3 * low, 1e3 * high));
}

}  // namespace

std::string to_string(Indenter indenter) {
  switch (indenter) {
    case Indenter::punch:
      return "punch";
    case Indenter::sphere:
      return "sphere";
    case Indenter::pressure:
      return "pressure";
  }
  return {};
}

Indenter indenter_of(const std::string& name) {
  for (const Indenter i : {Indenter::punch, Indenter::sphere, Indenter::pressure})
    if (to_string(i) == name) return i;
  throw InputError(fmt::format("indenter: '{}'; expected punch, sphere or pressure", name));
}

void check(const IndentationExperiment& e) {
  expect_range("radius of the indenter", e.radius, 1e-4, 0.1);
  expect_range("thickness of the block", e.thickness, 1e-4, 10);
  expect_range("half width of the block", e.half_width, 2 * e.radius, 10);
  if (e.mucosa != 0) expect_range("thickness of the mucosa", e.mucosa, 1e-5, 0.9 * e.thickness);
  if (!(e.poisson_ratio >= 0.3 && e.poisson_ratio <= 0.4999))
    throw InputError(fmt::format("Poisson ratio: {:g}; expected 0.3 to 0.4999", e.poisson_ratio));
}

double bulk_over_a10(double nu) { return 4 * (1 + nu) / (3 * (1 - 2 * nu)); }

}  // namespace genio
