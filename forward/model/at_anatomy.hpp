#pragma once
// A model at an anatomy: what the values of its modes make of its rest configuration.

#include <deque>
#include <map>
#include <mutex>
#include <span>

#include "forward/model/model.hpp"

namespace genio {

/// The latest few rest configurations that a model was asked for. Any number of threads may ask.
class AnatomyShapes {
 public:
  /// The model with its rest configuration moved by these values, one a mode. Throws InputError
  /// where they turn an element inside out.
  std::shared_ptr<const Model> at(const Model& model, const std::vector<double>& values);

 private:
  std::mutex mutex_;
  std::deque<std::pair<std::vector<double>, std::shared_ptr<const Model>>> kept_;
};

/// The model as its modes' values in `p` make it: the same nodes, couplings and parameters in the
/// same places, with its own rest configuration. It is the model itself where there are no modes or
/// all are 0, and then it must not outlive that. Shares of fibres, and which points may touch a
/// bone, stay those of the model, so that energies are smooth in the values. Throws InputError
/// where the values turn an element inside out.
std::shared_ptr<const Model> at_anatomy(const Model& model, const Parameters& p);

/// The model at the anatomy that its file states.
std::shared_ptr<const Model> at_anatomy(const Model& model);

/// The part of nodal displacements that the unknowns can follow; nodes that move as one body follow
/// their mean, so that a symmetric field has a symmetric part.
Vector followed(const DofMap& dofs, const Vector& field);

/// How far each parameter moves what no unknown can move, by the node: dx/dp at fixed unknowns
/// (3 n x count [m per unit]). It is zero but for modes of anatomy, which move the bones.
Matrix held_motion(const Model& model, std::span<const int> parameters);

/// The same by a mode of the model's description, by its number [m per standard deviation]. The
/// model need not have the effect `anatomy`.
Vector held_by_mode(const Model& model, int mode);

/// A shape of some anatomy, carried along the modes to that of `p`: as far as those nodes tell that
/// the bones hold, and exactly where the shape is the model's rest.
Positions carried(const Model& model, const Positions& shape, const Parameters& p);

/// The values of a model's modes by their names [standard deviations]; none without the effect.
std::map<std::string, double> anatomy_values(const Model& model, const Parameters& p);

/// Number of the mode that parameter `k` is the value of; -1: of none.
int mode_of(const Model& model, int k);
/// Number of the mode of the model's description with this name; -1: none.
int mode_named(const Model& model, const std::string& name);

}  // namespace genio
