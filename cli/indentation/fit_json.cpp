#include "cli/indentation/fit_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace genio::cli {
namespace {

using Json = nlohmann::json;

Json experiment_json(const IndentationExperiment& e) {
  Json j = {{"indenter", to_string(e.indenter)},
            {"radius_mm", 1e3 * e.radius},
            {"thickness_mm", 1e3 * e.thickness},
            {"half_width_mm", 1e3 * e.half_width},
            {"poisson_ratio", e.poisson_ratio}};
  if (e.mucosa > 0) j["mucosa_mm"] = 1e3 * e.mucosa;
  return j;
}

void add_constants(Json& j, const TissueFit& fit) {
  for (const FittedConstant& c : fit.constants) {
    j[c.name + "_Pa"] = c.value;
    j["sd"][c.name + "_Pa"] = c.sd;
    j["interval90"][c.name + "_Pa"] = {c.low, c.high};
    if (c.at_bound) j["at_bound"].push_back(c.name);
  }
  j["young_modulus_kPa"] = 1e-3 * fit.young_modulus;
  j["sd"]["young_modulus_kPa"] = 6e-3 * fit.constants.front().sd;
  const auto n = fit.covariance.rows();
  for (Eigen::Index a = 0; a < n; ++a) {
    j["constants"].push_back(fit.constants[size_t(a)].name);
    Json covariance = Json::array(), correlation = Json::array();
    for (Eigen::Index b = 0; b < n; ++b) {
      covariance.push_back(fit.covariance(a, b));
      correlation.push_back(fit.covariance(a, b) /
                            std::sqrt(fit.covariance(a, a) * fit.covariance(b, b)));
    }
    j["covariance_Pa2"].push_back(covariance);
    j["correlation"].push_back(correlation);
  }
}

}  // namespace

std::string fit_json(const IndentationExperiment& e, const ForceData& data, const TissueFit& fit,
                     int indent) {
  Json j = {{"status", fit ? "converged" : "failed"},
            {"message", fit.message},
            {"experiment", experiment_json(e)},
            {"layers", e.mucosa > 0 ? 2 : 1},
            {"points", data.depth.size()},
            {"forward_simulations", fit.simulations},
            {"equilibria", fit.equilibria},
            {"newton_iterations", fit.newton_iterations},
            {"factorizations", fit.factorizations},
            {"wall_s", fit.wall_s}};
  if (fit) {
    add_constants(j, fit);
    j["rms_N"] = fit.rms;
    j["chi2_per_dof"] = fit.chi2_per_dof;
    if (!data.sd) j["estimated_scatter"] = fit.scatter;
    if (e.mucosa > 0)
      j["mucosa"] = {{"a10_Pa", fit.tissue.mucosa.a10},
                     {"a20_Pa", fit.tissue.mucosa.a20},
                     {"fitted", fit.constants.size() > 2}};
  }
  return j.dump(indent);
}

}  // namespace genio::cli
