#pragma once
// How strongly a hidden change shows in the data of a case.

#include "bench/experiments/hidden_change.hpp"
#include "bench/experiments/hidden_data.hpp"
#include "bench/problems/measure.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio::bench {

constexpr double force_error = 0.1;  ///< of known forces

using Forces_N = std::map<std::string, double>;  ///< of both sides together

/// Parameters under these forces; `half`: of half a tongue.
Parameters commanded(const Model& model, const Forces_N& forces, bool half = false);

/// Changes with their amplitudes.
struct Changes {
  std::vector<HiddenChange> all;
  std::vector<double> s;

  ModelDescription truth(ModelDescription d) const {
    for (size_t i = 0; i < all.size(); ++i) d = all[i].truth(std::move(d), s[i]);
    return d;
  }
  ModelDescription shipped(ModelDescription d) const {
    for (size_t i = 0; i < all.size(); ++i) d = all[i].shipped(std::move(d), s[i]);
    return d;
  }
  Model by_hand(const Model& model) const {
    std::optional<Model> changed(model);
    for (size_t i = 0; i < all.size(); ++i)
      if (all[i].by_hand) changed.emplace(all[i].by_hand(*changed, s[i]));
    return *changed;
  }
  HeadPose pose() const {
    HeadPose p;
    for (size_t i = 0; i < all.size(); ++i)
      if (all[i].pose) p = all[i].pose(s[i]);
    return p;
  }
  bool symmetric() const {
    return std::all_of(all.begin(), all.end(), [](const auto& c) { return c.symmetric; });
  }
};

/// What is seen of a shape of a case, laid as its changes have it; without noise.
std::vector<Measured> seen(const Model& model, const Positions& x, const HiddenCase& what,
                           const Changes& changes, std::mt19937& random);

/// The amplitude that gives the strength asked for: what of the change's marks on the data is left
/// once the forces have done their best, in units of the noise (root mean square over points and
/// postures); on the coarse mesh. False where it is out of reach.
bool find_amplitude(const ModelDescription& tongue, const HiddenChange& change,
                    const std::vector<Forces_N>& fitted, const HiddenCase& what, double strength,
                    double& s);

}  // namespace genio::bench
