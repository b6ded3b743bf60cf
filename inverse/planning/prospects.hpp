#pragma once
// What a further measurement of the same shape would tell of the muscles.

#include <functional>
#include <map>

#include "inverse/shape/infer.hpp"

namespace genio {

/// A measurement that could be made beside those that were.
struct FurtherMeasurement {
  std::string name;
  Target points = {};                         ///< where it would meet the shape, without noise [m]
  std::map<std::string, double> emg_sd = {};  ///< of a muscle's activation
  std::map<std::string, double> parameter_sd = {};  ///< of a parameter that is estimated along
};

/// Of a muscle's force: the width of its 90 % interval [N], and how far it is from known whether it
/// acts, min(P, 1 - P) of the probability P that it does.
struct Doubt {
  double width = 0, acts = 0;
};

/// Of one measurement, means over draws of the truth.
struct Prospect {
  std::string name;
  Eigen::Index values = 0;       ///< numbers that it brings
  std::vector<Doubt> muscles;    ///< that would be left, as Prospects::muscles
  std::vector<double> widths{};  ///< the same widths of each draw, one draw's after another's
  double gain = 0;  ///< part of all widths, each over its muscle's maximum, that it would take away
};

struct Prospects {
  std::vector<std::string> muscles;
  std::vector<double> maximum;    ///< [N]
  std::vector<Doubt> before;      ///< with what was measured
  std::vector<Prospect> further;  ///< in the candidates' order
};

struct ProspectOptions {
  int draws = 8;
  std::function<void(int done, int all)> progress;  ///< by candidates
};

/// Expects what each candidate leaves in doubt, once it is measured. Truths are drawn from the
/// posterior of `target`, of which `answer` is the optimum; what each candidate would read under
/// them is simulated, with its noise and with the model's error as far as the residuals do not tell
/// it already; and the posterior is taken with both. The shape's derivative at the answer stands
/// for the mechanics. All candidates see the same truths. Throws InputError for a muscle or
/// parameter that is not estimated, and where no derivative is found.
Prospects prospects(const Model& model, const Target& target, const Prior& prior,
                    const Answer& answer, const std::vector<FurtherMeasurement>& candidates,
                    Workspace& ws, const InferOptions& options, const ProspectOptions& how = {});

}  // namespace genio
